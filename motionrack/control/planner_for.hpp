// The planner of a card's axes.
#pragma once

#include <motionrack/control/path.hpp>
#include <motionrack/control/path_axes.hpp>
#include <motionrack/control/ride/ride_moves.hpp>

namespace motionrack::control {

/// The limits for planning: a part of each axis' acceleration (0 .. 0.5) is the card's.
inline MachineLimits without_kept_back(MachineLimits limits, double kept_back) {
    for (AxisLimits& axis : limits) axis.max_accel *= 1 - kept_back;
    return limits;
}

/// Trapezoids, as the card asks of joints. `start`: where the axes stand. The axes must live as long.
inline Planner planner_for(const PathAxes& axes, const MachineLimits& limits, double kept_back,
                           PlannerSettings settings, const Point& start) {
    settings.drive = axes.drive_rule();
    return Planner(without_kept_back(limits, kept_back), start, settings);
}

/// The same with limited jerk.
inline RideMoves ride_for(const PathAxes& axes, const MachineLimits& limits, double kept_back,
                          RideMovesSettings settings, const Point& start) {
    settings.drive = axes.drive_rule();
    return RideMoves(without_kept_back(limits, kept_back), start, settings);
}

}  // namespace motionrack::control
