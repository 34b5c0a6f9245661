// Interval of a path with constant limits along it.
#pragma once

namespace motionrack::control {

/// Limits on an interval, per unit of path (mm, degrees) and second; all above 0 and finite. A motion within these path
/// limits is within the limits of every axis.
struct LimitInterval {
    double length = 0;
    double velocity = 0;
    double accel = 0;      ///< acceleration limit at any velocity up to `velocity`
    double jerk = 0;       ///< jerk limit, up and down, at any velocity and acceleration up to these limits
    double brake = accel;  ///< deceleration limit at any velocity up to `velocity`
};

}  // namespace motionrack::control
