// Interval of a path with constant limits along it.
#pragma once

namespace motionrack::control {

/// Per unit of path (mm, degrees) and second; all above 0 and finite. A motion within these path limits is within the
/// limits of every axis.
struct LimitInterval {
    double length = 0;
    double velocity = 0;
    double accel = 0;      ///< acceleration limit at any velocity up to `velocity`
    double jerk = 0;       ///< in both directions, at any velocity and acceleration up to these
    double brake = accel;  ///< deceleration limit at any velocity up to `velocity`
};

}  // namespace motionrack::control
