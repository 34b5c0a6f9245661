// Runs a marking job on the virtual card in a simulated machine, with and without correction, and returns the marks on
// the part.
#pragma once

#include <algorithm>
#include <functional>
#include <motionrack/mark/marking_host.hpp>
#include <motionrack/mark/overflow.hpp>
#include <motionrack/mark/plan.hpp>
#include <motionrack/sim/parts/workpiece.hpp>

namespace motionrack::mark {

/// Spot position commanded by the card at an instant, and the fraction of time since the last sample with the gate
/// open.
struct FieldSample {
    double at_s = 0;
    Spot at;  ///< mm in the field, with ideal mirrors
    double gate = 0;
};
inline constexpr std::int64_t max_field_samples = 10'000;

enum class PartOutcome : std::uint8_t {
    marked,
    lost_busy,      ///< its start came while the list of another part was running
    lost_too_many,  ///< eight starts were queued when its edge came
    not_started     ///< the card was not armed for its start, because the start of an earlier part was lost
};

constexpr const char* name_of(PartOutcome fate) {
    switch (fate) {
        case PartOutcome::marked:
            return "marked";
        case PartOutcome::lost_busy:
            return "lost: a list was running";
        case PartOutcome::lost_too_many:
            return "lost: eight were waiting";
        default:
            return "not started";
    }
}

/// Result of one part.
struct PartMarked {
    PartOutcome fate = PartOutcome::marked;
    std::int64_t number = 0;        ///< value of {n}, if marked
    std::size_t drawing = 0;        ///< index for Prepared::of(); a lost part: the drawing that it would have got
    double begin_s = 0, end_s = 0;  ///< execution of the list; a lost part: both are the instant of its start
    parts::Deviation deviation;     ///< in part coordinates
    double marked_mm = 0;
    std::size_t first_point = 0, points = 0;  ///< in Marked::points
    Affine
        shown;  ///< part to picture coordinates, without overlapping parts: a table as it is, belt parts side by side
};

/// Result of one run.
struct Marked {
    parts::Deviation deviation;              ///< over all parts
    std::vector<parts::MarkedPoint> points;  ///< each in the coordinates of its part
    std::vector<PartMarked> parts;           ///< in the order of arrival; one if the job has no [parts]
    std::uint64_t lost_points = 0;
    double seconds = 0;  ///< duration until the card is idle, s
    double duty = 0;     ///< fraction of `seconds` with the gate open
    double marked_mm = 0, energy_j = 0;
    Box reach;                         ///< mm in the field: range of the corrected list without clipping
    std::vector<FieldSample> course;   ///< at equal steps, about max_field_samples
    std::vector<Overflow> overflows;   ///< all intervals with the corrected position outside the field, ordered by end
    std::uint64_t lost_overflows = 0;  ///< number beyond OverflowLog::max_places

    std::size_t parts_lost() const {
        return static_cast<std::size_t>(std::count_if(
            parts.begin(), parts.end(), [](const PartMarked& p) { return p.fate != PartOutcome::marked; }));
    }
    /// Returns true if the correction stayed in the field and no part was lost.
    bool good() const { return overflows.empty() && parts_lost() == 0; }
};

struct MarkingOutcome {
    Marked on;                  ///< marks with the settings of the job
    std::optional<Marked> off;  ///< the same without correction; empty if the job has none
    double drawing_mm = 0;
    std::size_t strokes = 0, elements = 0;
    bool drawing_in_field = true;  ///< the drawing of a stationary part fits into the field; true with waits
    /// Maximum velocity factor of the part before the corrected position leaves the field; empty without correction or
    /// movement. 0: the drawing does not fit even at standstill.
    std::optional<double> fits_factor;
    bool fits_any = false;      ///< fits at all tested velocities (up to 1000 times)
    bool starts_limit = false;  ///< limited by a lost start, not by the field
    Box field;                  ///< mm
    bool waits = false;         ///< the job uses waits: marks keep its margin from the field edge
    std::vector<std::string> notes;
    /// Returns true if the job tracks the part, or the drawing fits into the field without tracking.
    bool in_field() const { return off || drawing_in_field; }
};

/// Runs a job. Errors: those of MarkingHost; refused if waits are used and the belt is too fast for them.
Result<MarkingOutcome> run_job(const MarkingJob& job, const Prepared& prepared, const RunObserver& watch = {});

}  // namespace motionrack::mark
