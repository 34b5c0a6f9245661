// When and where the corrected position was outside the field: every stretch of ticks, not only the first.
//
//   corrected x  ____/^^^^\____/^\___     each stretch above the edge is one Overflow
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

/// A stretch of time in which a bit of get_marking_info would have been set anew in each tick.
struct Overflow {
    std::string name, meaning;  ///< of the bit: "FLY_X_OVERFLOW"
    double from_s = 0, to_s = 0;
    Spot field;               ///< where the card should have put the spot at from_s, mm; beyond the field
    Spot part;                ///< the same place in the part's coordinates: where on the drawing
    std::size_t part_no = 0;  ///< which part, from 0 on
    double beyond_mm = 0;     ///< how far beyond the edge it was at most
    bool marking = false;     ///< the laser was on in some of it: the marks there are displaced
};

/// Listens to a card's samples.
class OverflowLog {
  public:
    static constexpr std::size_t most = 10'000;  ///< more are counted, not kept

    /// `track` must live as long.
    OverflowLog(double bits_per_mm, const parts::Conveyor& track) : k_(bits_per_mm), track_(track) {}
    void block(const rtc5::Samples& samples);
    /// Nothing comes after `tick`.
    void finish(std::int64_t tick);

    const std::vector<Overflow>& all() const { return all_; }
    std::uint64_t lost() const { return lost_; }

  private:
    struct Open {
        bool open = false, marking = false;
        std::int64_t since = 0;
        rtc5::Point at;
        double beyond = 0;  ///< bits
    };
    void look(std::int64_t tick, rtc5::Point at, bool laser);
    void close(std::size_t edge, std::int64_t tick);

    double k_;
    const parts::Conveyor& track_;
    std::array<Open, 4> edges_{};
    std::vector<Overflow> all_;
    std::uint64_t lost_ = 0;
};

}  // namespace motionrack::mark
