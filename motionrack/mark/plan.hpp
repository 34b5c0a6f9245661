// Converts a job to the card's list: speeds, delays and correction first, then jumps, marks and arcs in bits.
#pragma once

#include <memory>
#include <motionrack/cards/rtc5/map.hpp>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/mark/marking_job.hpp>
#include <vector>

namespace motionrack::mark {

struct PartDrawing {
    Drawing drawing;
    std::vector<parts::DrawnSegment> segments;  ///< the drawing as straight segments
};

/// Prepared input of a job for any number of runs. It is itself the drawing of the first part.
struct Prepared : PartDrawing {
    std::vector<PartDrawing> further;  ///< from the second marked part on; empty: all equal the first
    double bits_per_mm = 0;
    std::optional<sim::ScanLens> lens;
    std::shared_ptr<const rtc5::Table> table;  ///< empty: 1:1
    std::vector<std::string> notes;            ///< warnings before the run

    /// Returns the drawing of the part with mark index `marked`, from 0.
    const PartDrawing& of(std::size_t marked) const {
        return marked == 0 || further.empty() ? *this : further[marked - 1];
    }
    /// Returns the range of the card's output, mm.
    Box field() const;
};

/// Reads the files of a job and prepares its drawings and tables. Errors: those of the files.
Result<Prepared> prepare(const MarkingJob& job, const Load& load);

/// Movement of the part and its tracking by the card.
struct ConveyorTracking {
    parts::ConveyorSettings track;
    FlyMode mode = FlyMode::off;
    double simulated_velocity = 0;  ///< mm/s or degrees/s represented by the simulated encoder
    bool corrects = true;           ///< false: waits and tracking remain, but the list does not correct the position
};
/// Returns the tracking of a job, with all velocities multiplied by `factor`.
ConveyorTracking following_of(const MarkingJob& job, double factor = 1);
/// Returns the encoder counts or word units per mm or degree of movement; 0: no tracking.
double counts_per_unit(const MarkingJob& job, const ConveyorTracking& following);
/// Returns a belt distance (mm or degrees) as whole counts, signed.
double counts_of(const MarkingJob& job, const ConveyorTracking& following, double travel);

/// Returns the list for the part with mark index `marked`, including set_end_of_list. Errors: refused if the card does
/// not accept a speed, position or scale, or the drawing never enters the field.
Result<std::vector<rtc5::Command>> list_of(const MarkingJob& job, const Prepared& prepared,
                                           const ConveyorTracking& following, std::size_t marked = 0);
/// Returns the list that, before the first start, requests an encoder reset at that start. Errors: as list_of.
Result<std::vector<rtc5::Command>> arming_list_of(const MarkingJob& job, const Prepared& prepared,
                                                  const ConveyorTracking& following);

}  // namespace motionrack::mark
