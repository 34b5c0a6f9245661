// What one axis may do, in user units; the planner keeps every limit at every instant.
#pragma once

#include <array>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// Limits of one axis, in mm (linear) or degrees (rotary) and seconds; all finite, speeds and accelerations > 0.
struct AxisLimits {
    bool present = false;     ///< the rack has this axis
    double min_position = 0;  ///< least position that may be commanded
    double max_position = 0;  ///< greatest position that may be commanded
    double max_velocity = 0;  ///< per second
    double max_accel = 0;     ///< per second squared
    double max_jerk = 0;      ///< per second cubed; 0 = trapezoids only
    double max_velocity_step =
        0;  ///< speed that may be reached at once from standstill, and the largest jump at a corner
    double pulses_per_unit = 0;  ///< pulses a mm or a degree; one pulse is the smallest move
};

using MachineLimits = std::array<AxisLimits, axis_count>;

}  // namespace motionrack::control
