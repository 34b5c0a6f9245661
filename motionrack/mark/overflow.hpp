// Intervals in which the corrected position was outside the field; all intervals, not only the first.
//
//  corrected x  ____/^^^^\____/^\___     each interval above the edge is one Overflow
//   edge         - - - - - - - - - -
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/rtc5/model/engine.hpp>
#include <motionrack/sim/parts/conveyor.hpp>
#include <string>
#include <vector>

namespace motionrack::mark {

using sim::Spot;

/// Interval in which a bit of get_marking_info would have been set in each tick.
struct Overflow {
    std::string name, meaning;  ///< name and meaning of the bit: "FLY_X_OVERFLOW"
    double from_s = 0, to_s = 0;
    Spot field;               ///< commanded spot at from_s, mm; outside the field
    Spot part;                ///< the same spot in part coordinates, to locate it on the drawing
    std::size_t part_no = 0;  ///< part index, from 0
    double beyond_mm = 0;     ///< maximum distance beyond the edge
    bool marking = false;     ///< true: the laser was on during a part of the interval, so marks are displaced
};

/// Receives the samples of a card and records the intervals outside the field.
class OverflowLog {
  public:
    static constexpr std::size_t max_places = 10'000;  ///< further ones are counted but not stored

    /// `track` must outlive the object.
    OverflowLog(double bits_per_mm, const parts::Conveyor& track) : k_(bits_per_mm), track_(track) {}
    void block(const rtc5::Samples& samples);
    /// Ends the log; no samples follow after `tick`.
    void finish(std::int64_t tick);

    const std::vector<Overflow>& all() const { return all_; }
    std::uint64_t lost() const { return lost_; }

  private:
    struct Open {
        bool open = false, marking = false;
        std::int64_t since = 0;
        rtc5::Point at;
        double beyond = 0;  ///< maximum distance beyond the edge so far, bits
    };
    void sample(std::int64_t tick, rtc5::Point at, bool laser);
    void close(std::size_t edge, std::int64_t tick);

    double k_;
    const parts::Conveyor& track_;
    std::array<Open, 4> edges_{};
    std::vector<Overflow> all_;
    std::uint64_t lost_ = 0;
};

}  // namespace motionrack::mark
