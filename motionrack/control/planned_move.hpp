// A planned move: a canonical move with the velocities that the look-ahead found.
#pragma once

#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// The velocity along the path changes from `entry_velocity` to `cruise_velocity` and then to `exit_velocity`, both at
/// `accel`. If XYZ moves, lengths are mm along the XYZ path (helix: along the helix); if only ABC moves, degrees of the
/// fastest rotary axis.
struct PlannedMove {
    Move move;
    Point start = {};
    double length = 0;            ///< mm or degrees, > 0; 0 for a dwell
    double entry_velocity = 0;    ///< per second
    double cruise_velocity = 0;   ///< highest velocity reached or allowed, per second
    double exit_velocity = 0;     ///< per second
    double accel = 0;             ///< along the path, per second squared, for acceleration and deceleration
    bool constant_accel = false;  ///< the velocity changes uniformly from entry to exit over the whole length
    std::uint8_t axes = 0;  ///< axes that move anywhere on the path that this is a part of, one bit each, X the lowest;
                            ///< 0: the axes that move here
    std::int64_t number = 0;  ///< number of its first move, in the order of push, from 0
    std::int32_t moves = 1;   ///< number of short moves merged into this line
    double jerk = 0;  ///< along the path, per second cubed; gives a double-S profile if the move starts and ends at
                      ///< standstill; 0: none
};

}  // namespace motionrack::control
