// The planner of a card's axes.
#pragma once

#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/trajectory/trajectory_interpolator.hpp>

namespace motionrack::control {

/// The limits for planning: a part of each axis' acceleration (0 .. 0.5) is the card's.
inline MachineLimits without_accel_reserve(MachineLimits limits, double accel_reserve) {
    for (AxisLimits& axis : limits) axis.max_accel *= 1 - accel_reserve;
    return limits;
}

/// Trapezoids, as the card asks of joints. `start`: where the axes stand. The axes must live as long.
inline LookAheadPlanner make_look_ahead_planner(const AxisGroup& axes, const MachineLimits& limits,
                                                double accel_reserve, LookAheadSettings settings, const Point& start) {
    settings.drive = axes.drive_constraints();
    return LookAheadPlanner(without_accel_reserve(limits, accel_reserve), start, settings);
}

/// The same with limited jerk.
inline TrajectoryInterpolator make_trajectory_interpolator(const AxisGroup& axes, const MachineLimits& limits,
                                                           double accel_reserve, InterpolatorSettings settings,
                                                           const Point& start) {
    settings.drive = axes.drive_constraints();
    return TrajectoryInterpolator(without_accel_reserve(limits, accel_reserve), start, settings);
}

}  // namespace motionrack::control
