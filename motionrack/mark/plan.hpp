// From a job to the card's list: speeds, delays and correction first, then jumps, marks and arcs in bits.
#pragma once

#include <memory>
#include <motionrack/cards/rtc5/map.hpp>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/mark/job.hpp>
#include <vector>

namespace motionrack::mark {

/// What a job marks and with what; made once, run as often as wanted.
struct Prepared {
    Drawing drawing;
    std::vector<parts::Segment> segments;  ///< the drawing as straight pieces
    double bits_per_mm = 0;
    std::optional<sim::ScanLens> lens;
    std::shared_ptr<const rtc5::Table> table;  ///< none: 1:1
    std::vector<std::string> notes;            ///< what the user should know before
};

/// Errors: of the files the job names.
Result<Prepared> prepare(const Job& job, const Load& load);

/// The movement of the part and how the card follows it.
struct Following {
    parts::TrackSettings track;
    FlyMode mode = FlyMode::off;
};
/// A job's, with all speeds times `factor`.
Following following_of(const Job& job, double factor = 1);

/// The list, up to and with set_end_of_list. Errors: refused: a speed, place or scale that the card does not take.
Result<std::vector<rtc5::Command>> list_of(const Job& job, const Prepared& prepared, const Following& following);

}  // namespace motionrack::mark
