// From a job to the card's list: speeds, delays and correction first, then jumps, marks and arcs in bits.
#pragma once

#include <memory>
#include <motionrack/cards/rtc5/map.hpp>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/mark/marking_job.hpp>
#include <vector>

namespace motionrack::mark {

struct PartDrawing {
    Drawing drawing;
    std::vector<parts::Segment> segments;  ///< the drawing as straight pieces
};

/// What a job marks and with what; made once, run as often as wanted. It is itself the first part's drawing.
struct Prepared : PartDrawing {
    std::vector<PartDrawing> further;  ///< of the second marked part on; empty: all are like the first
    double bits_per_mm = 0;
    std::optional<sim::ScanLens> lens;
    std::shared_ptr<const rtc5::Table> table;  ///< none: 1:1
    std::vector<std::string> notes;            ///< what the user should know before

    /// Of the part that is marked `marked`th, from 0 on.
    const PartDrawing& of(std::size_t marked) const {
        return marked == 0 || further.empty() ? *this : further[marked - 1];
    }
    /// mm that the card's output reaches.
    Box field() const;
};

/// Errors: of the files the job names.
Result<Prepared> prepare(const MarkingJob& job, const Load& load);

/// The movement of the part and how the card follows it.
struct ConveyorTracking {
    parts::ConveyorSettings track;
    FlyMode mode = FlyMode::off;
    double simulated_speed = 0;  ///< mm/s or degrees/s that the simulated encoder stands for
    bool corrects = true;        ///< false: all is done but the correction
};
/// A job's, with all speeds times `factor`.
ConveyorTracking following_of(const MarkingJob& job, double factor = 1);
/// What one mm or degree of movement is in the numbers that the card gets; 0: nothing.
double counts_per_unit(const MarkingJob& job, const ConveyorTracking& following);
/// Whole counts of a way that the belt goes, with their sign.
double counts_of(const MarkingJob& job, const ConveyorTracking& following, double way);

/// The list of the part that is marked `marked`th, up to and with set_end_of_list. Errors: refused: a speed, place or
/// scale that the card does not take; a drawing that does not come into the field.
Result<std::vector<rtc5::Command>> list_of(const MarkingJob& job, const Prepared& prepared,
                                           const ConveyorTracking& following, std::size_t marked = 0);
/// Before the first start: asks for the encoders to become 0 at it. Errors: as list_of.
Result<std::vector<rtc5::Command>> arming_list_of(const MarkingJob& job, const Prepared& prepared,
                                                  const ConveyorTracking& following);

}  // namespace motionrack::mark
