// Programs on cards that position each axis independently: every straight move becomes one command for each axis that
// moves. The next move starts at standstill.
//
//   PlannedMove ─► move_to of each axis that moves ─► step all until standstill ─► the next
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
    /// `axes`: nullptr for a missing axis; the positions must be valid. `host`: provides the time.
    PointToPointAxes(const std::array<Axis*, axis_count>& axes, const MachineLimits& limits, Interrupt& host);

    Result<void> begin() override;
    /// Returns at standstill. A feed rate is the velocity of the one axis that moves; a rapid uses the maximum velocity
    /// of each. Errors: those of Axis::move_to and Axis::wait; refused, an arc or a feed move of several axes.
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
    double velocity_of(const PlannedMove& move, std::size_t axis) const;

    std::array<Axis*, axis_count> axes_;
    MachineLimits limits_;
    Interrupt& host_;
    Point commanded_ = {};
    bool known_ = false;  ///< commanded_ is up to date; otherwise the cards are read
    std::int64_t blocks_ = 0;
    std::vector<MoveStart> starts_;
};

}  // namespace motionrack::control
