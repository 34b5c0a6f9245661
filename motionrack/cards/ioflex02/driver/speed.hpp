// Velocity of an axis from the card's own time stamps, by two methods, each with a strict error bound.
//
//   counts  ____|____|____|____|____|____
//   readings   ^                  ^            difference: counts between two readings / time between them      (quick)
//              .    |         |   .            edges (1/T): counts between two edges / time between those        (slow)
//                   last      last
//
// The age of the last count in each reading gives the instant of the last edge: to 1.2 us (the tick of the time) and
// 100 ns (the sample). The difference has an error of up to one count, the edges only of those 1.3 us. The estimate is
// the mean velocity over the stated interval; no bound exists for a velocity that changes within it.
#pragma once

#include <cstdint>
#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>

namespace motionrack::ioflex02 {

/// Mean velocity over an interval. The true mean is within `counts_s` +- `error`.
struct SpeedEstimate {
    bool known = false;
    double counts_s = 0;
    double error = 0;       ///< counts/s, >= 0
    std::int64_t from = 0;  ///< the interval, in ticks of Reading::ticks
    std::int64_t to = 0;
};

struct Speed {
    SpeedEstimate difference;  ///< between this reading and the previous one
    SpeedEstimate
        edges;  ///< between the last edges of this reading and an earlier one; without a new edge: since the last edge
    bool edge_came = false;  ///< `edges` uses a new edge
    /// The estimate with the smaller error; unknown before the second reading.
    const SpeedEstimate& best() const {
        return edges.known && (!difference.known || edges.error <= difference.error) ? edges : difference;
    }
};

class SpeedMeter {
  public:
    /// `edge_error`: maximum displacement of an encoder edge, counts (0: a perfect encoder); included in the errors.
    explicit SpeedMeter(double edge_error = 0) : edge_error_(edge_error) {}

    /// Adds a reading, in order of time, at any interval; `ticks` is Reading::ticks.
    Speed update(const AxisReading& axis, std::int64_t ticks);
    /// Discards all readings; also required after Flex2Pos::reset.
    void restart() { *this = SpeedMeter(edge_error_); }

  private:
    SpeedEstimate difference(const AxisReading& axis, std::int64_t ticks) const;
    SpeedEstimate silence(const AxisReading& axis, std::int64_t ticks) const;

    double edge_error_;
    bool begun_ = false;
    std::int64_t first_ticks_ = 0;
    std::int64_t ticks_ = 0, raw_ = 0;  // the previous reading
    bool edge_known_ = false;
    std::int64_t edge_ticks_ = 0, edge_place_ = 0;  // the last edge used
    double edge_speed_ = 0;
};

}  // namespace motionrack::ioflex02
