// A stretch of a path on which the limits along it stay the same.
#pragma once

namespace motionrack::control {

/// Per unit of path (mm, degrees) and second; all above 0 and finite. Whoever keeps these on the path keeps what the
/// axes can do.
struct LimitInterval {
    double length = 0;
    double speed = 0;
    double accel = 0;      ///< of speeding up, at any speed up to `speed`
    double jerk = 0;       ///< both ways, at any speed and acceleration up to these
    double brake = accel;  ///< the acceleration of slowing down, at any speed up to `speed`
};

}  // namespace motionrack::control
