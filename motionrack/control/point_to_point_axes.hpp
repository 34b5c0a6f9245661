// Programs on cards that position each axis by itself: every straight move becomes an order to the axes that it moves,
// and the next one waits until they stand.
//
//   PlannedMove ─► move_to of each axis that it moves ─► step all until they stand ─► the next
#pragma once

#include <array>
#include <motionrack/base/port.hpp>
#include <motionrack/control/axis.hpp>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/limits.hpp>
#include <vector>

namespace motionrack::control {

class PointToPointAxes final : public AxisGroup {
  public:
    /// `axes`: nullptr where there is none; they must be trusted. `host`: whose time passes.
    PointToPointAxes(const std::array<Axis*, axis_count>& axes, const MachineLimits& limits, Interrupt& host);

    Result<void> begin() override;
    /// Returns when the axes stand. A feed is the speed of the axis that moves, a traverse the greatest speed of each.
    /// Errors: those of Axis::move_to and Axis::wait; refused, an arc or a feed of several axes.
    Result<void> follow(const PlannedMove& move) override;
    Result<void> finish() override;
    void stop(bool immediate) override;
    Point commanded_position() override;
    std::vector<PathWarning> take_path_warnings() override { return {}; }
    std::vector<MoveStart> take_move_starts() override;

  private:
    void look_where_they_stand();
    Result<void> dwell(double seconds);
    Result<void> order(const PlannedMove& move);
    Result<void> wait();
    double speed_of(const PlannedMove& move, std::size_t axis) const;

    std::array<Axis*, axis_count> axes_;
    MachineLimits limits_;
    Interrupt& host_;
    Point commanded_ = {};
    bool known_ = false;  ///< where they were sent, or stand; else their cards are asked
    std::int64_t blocks_ = 0;
    std::vector<MoveStart> starts_;
};

}  // namespace motionrack::control
