// Speed of an axis from the card's own time stamps, in two ways, each with the error that it cannot exceed.
//
//   counts  ____|____|____|____|____|____
//   readings   ^                  ^            difference: counts between two readings / time between them      (quick)
//              .    |         |   .            edges (1/T): counts between two edges / time between those        (slow)
//                   last      last
//
// Each reading tells, by the age of the last count, when the last edge was: to 1.2 us (the time's tick) and 100 ns (the
// sample). The difference is off by up to a count, the edges only by those 1.3 us. What is estimated is the mean speed
// of the stretch that is named; of a speed that changes within the stretch no bound can be stated.
#pragma once

#include <cstdint>
#include <motionrack/cards/ioflex02/driver/flex2pos.hpp>

namespace motionrack::ioflex02 {

/// Mean speed of a stretch. The true mean is within `counts_s` +- `error`.
struct SpeedEstimate {
    bool known = false;
    double counts_s = 0;
    double error = 0;       ///< counts/s, >= 0
    std::int64_t from = 0;  ///< the stretch, in ticks of Reading::ticks
    std::int64_t to = 0;
};

struct Speed {
    SpeedEstimate difference;  ///< between this reading and the one before
    SpeedEstimate
        edges;  ///< between the last edges of this reading and of an earlier one; if no edge came: since the last edge
    bool edge_came = false;  ///< there was a new edge for `edges`
    /// The one with the smaller error; not known before the second reading.
    const SpeedEstimate& best() const {
        return edges.known && (!difference.known || edges.error <= difference.error) ? edges : difference;
    }
};

class SpeedMeter {
  public:
    /// `edge_error`: how far an edge of the encoder may be from its place, counts (0: a perfect one); it is in the
    /// errors.
    explicit SpeedMeter(double edge_error = 0) : edge_error_(edge_error) {}

    /// Readings in their order, at any distance; `ticks` is Reading::ticks.
    Speed update(const AxisReading& axis, std::int64_t ticks);
    /// Forgets what was; after Flex2Pos::reset, too.
    void restart() { *this = SpeedMeter(edge_error_); }

  private:
    SpeedEstimate difference(const AxisReading& axis, std::int64_t ticks) const;
    SpeedEstimate silence(const AxisReading& axis, std::int64_t ticks) const;

    double edge_error_;
    bool begun_ = false;
    std::int64_t first_ticks_ = 0;
    std::int64_t ticks_ = 0, raw_ = 0;  // of the reading before
    bool edge_known_ = false;
    std::int64_t edge_ticks_ = 0, edge_place_ = 0;  // the last edge that was used
    double edge_speed_ = 0;
};

}  // namespace motionrack::ioflex02
