// Factories for the planner of a card's axes.
#pragma once

#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/trajectory/trajectory_interpolator.hpp>

namespace motionrack::control {

/// Returns the limits for planning: each acceleration less the reserve of the card (a share, 0 .. 0.5).
inline MachineLimits without_accel_reserve(MachineLimits limits, double accel_reserve) {
    for (AxisLimits& axis : limits) axis.max_accel *= 1 - accel_reserve;
    return limits;
}

/// Makes a planner with trapezoidal profiles and the card's constraints. `start`: the current position. `axes` must
/// outlive the planner.
inline LookAheadPlanner make_look_ahead_planner(const AxisGroup& axes, const MachineLimits& limits,
                                                double accel_reserve, LookAheadSettings settings, const Point& start) {
    settings.drive = axes.drive_constraints();
    return LookAheadPlanner(without_accel_reserve(limits, accel_reserve), start, settings);
}

/// Makes a planner with limited jerk and the card's constraints; arguments as for make_look_ahead_planner().
inline TrajectoryInterpolator make_trajectory_interpolator(const AxisGroup& axes, const MachineLimits& limits,
                                                           double accel_reserve, InterpolatorSettings settings,
                                                           const Point& start) {
    settings.drive = axes.drive_constraints();
    return TrajectoryInterpolator(without_accel_reserve(limits, accel_reserve), start, settings);
}

}  // namespace motionrack::control
