// Runs a marking job on the virtual card in a simulated machine, with its correction and without, and says what is on
// the part.
#pragma once

#include <algorithm>
#include <functional>
#include <motionrack/mark/marking_host.hpp>
#include <motionrack/mark/overflow.hpp>
#include <motionrack/mark/plan.hpp>
#include <motionrack/sim/parts/workpiece.hpp>

namespace motionrack::mark {

/// Where the card's output had the spot at an instant, and the part of the time since the last one that its gate was
/// open.
struct FieldSample {
    double at_s = 0;
    Spot at;  ///< mm in the field, of mirrors without delay
    double gate = 0;
};
inline constexpr std::int64_t max_field_samples = 10'000;

enum class PartOutcome : std::uint8_t {
    marked,
    lost_busy,      ///< its start came while the list of another part ran
    lost_too_many,  ///< eight starts were waiting as its edge came
    not_started     ///< the card was not asked for its start, because that of an earlier part was lost
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

/// What became of one part.
struct PartMarked {
    PartOutcome fate = PartOutcome::marked;
    std::int64_t number = 0;        ///< of {n}, if it was marked
    std::size_t drawing = 0;        ///< Prepared::of; of a lost part the one it would have got
    double begin_s = 0, end_s = 0;  ///< of its list; when lost: the instant
    parts::Deviation deviation;     ///< in its own coordinates
    double marked_mm = 0;
    std::size_t first_point = 0, points = 0;  ///< of Marked::points
    Affine shown;  ///< its coordinates to those of a picture in which no part lies on another: a table as it is, parts
                   ///< of a belt side by side
};

/// One run.
struct Marked {
    parts::Deviation deviation;              ///< of all parts
    std::vector<parts::MarkedPoint> points;  ///< each in its own part's coordinates
    std::vector<PartMarked> parts;           ///< in the order in which they pass; one if the job has no [parts]
    std::uint64_t lost_points = 0;
    double seconds = 0;  ///< until the card rests
    double duty = 0;     ///< part of it with the gate open
    double marked_mm = 0, energy_j = 0;
    Box reach;  ///< mm in the field: how far the list went with its correction, were there no edge
    std::vector<FieldSample> course;  ///< in even steps, about max_field_samples
    std::vector<Overflow>
        overflows;  ///< every stretch in which the corrected position was outside the field, in the order of their ends
    std::uint64_t lost_overflows = 0;  ///< more than OverflowLog::most

    std::size_t parts_lost() const {
        return static_cast<std::size_t>(std::count_if(
            parts.begin(), parts.end(), [](const PartMarked& p) { return p.fate != PartOutcome::marked; }));
    }
    /// The correction stayed in the field and no part was lost.
    bool good() const { return overflows.empty() && parts_lost() == 0; }
};

struct MarkingOutcome {
    Marked on;                  ///< as the job says
    std::optional<Marked> off;  ///< the same without correction; none if the job has none
    double drawing_mm = 0;
    std::size_t strokes = 0, elements = 0;
    bool drawing_in_field = true;  ///< without the part's movement
    /// How many times its speed the part may have until the corrected position leaves the field; none without
    /// correction or movement. 0: the drawing does not fit even at rest.
    std::optional<double> fits_factor;
    bool fits_any = false;      ///< it fits at any speed that was tried (1000 times)
    bool starts_limit = false;  ///< what ends it is a start that is lost, not the field
    Box field;                  ///< mm
    bool waits = false;         ///< marks keep the job's own margin from the field's edge
    std::vector<std::string> notes;
    /// A part that is not followed has to lie in the field as it is.
    bool in_field() const { return off || drawing_in_field; }
};

/// Errors: as Line; refused: waits on a belt that is too fast for them.
Result<MarkingOutcome> run_job(const MarkingJob& job, const Prepared& prepared, const Watch& watch = {});

}  // namespace motionrack::mark
