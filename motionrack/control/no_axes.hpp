// Axis group of a machine without axes: always at standstill. Such a machine measures, marks or is in service.
#pragma once

#include <motionrack/control/axis_group.hpp>

namespace motionrack::control {

class NoAxes final : public AxisGroup {
  public:
    Result<void> begin() override { return {}; }
    /// Always refused.
    Result<void> follow(const PlannedMove&) override {
        return fail(ErrorKind::refused, "The machine has no axes. Nothing was moved.");
    }
    Result<void> finish() override { return {}; }
    void stop(bool) override {}
    Point commanded_position() override { return {}; }
    std::vector<PathWarning> take_path_warnings() override { return {}; }
    std::vector<MoveStart> take_move_starts() override { return {}; }
};

}  // namespace motionrack::control
