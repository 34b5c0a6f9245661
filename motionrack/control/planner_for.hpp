// The planner of a card's axes.
#pragma once

#include <motionrack/control/path.hpp>
#include <motionrack/control/path_axes.hpp>

namespace motionrack::control {

/// Keeps `kept_back` (0 .. 0.5) of each axis' acceleration back for the card, and to what the card asks of joints. `start`: where the axes
/// stand. The axes must live as long.
inline Planner planner_for(const PathAxes& axes, MachineLimits limits, double kept_back, PlannerSettings settings, const Point& start) {
    for (AxisLimits& axis : limits) axis.max_accel *= 1 - kept_back;
    settings.drive = axes.drive_rule();
    return Planner(limits, start, settings);
}

}  // namespace motionrack::control
