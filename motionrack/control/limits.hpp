// Limits of one axis in user units; the planner observes every limit at every instant.
#pragma once

#include <array>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// Limits of one axis, in mm (linear) or degrees (rotary) and seconds; all finite, velocities and accelerations > 0.
struct AxisLimits {
    bool present = false;     ///< the rack has this axis
    double min_position = 0;  ///< lower soft limit
    double max_position = 0;  ///< upper soft limit
    double max_velocity = 0;  ///< per second
    double max_accel = 0;     ///< per second squared
    double max_jerk = 0;      ///< per second cubed; 0 = trapezoidal profiles only
    double max_velocity_step =
        0;  ///< velocity that may be reached at once from standstill, and the largest velocity step at a corner
    double pulses_per_unit = 0;  ///< pulses per mm or degree; one pulse is the smallest move
};

using MachineLimits = std::array<AxisLimits, axis_count>;

}  // namespace motionrack::control
