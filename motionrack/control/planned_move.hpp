// A planned move: a canonical move with the speeds that look-ahead found for it.
#pragma once

#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// Speed along the path rises from `entry` to `cruise` at `accel`, and falls to `exit` at `accel`. Where XYZ moves,
/// lengths are mm along the XYZ path (helix: along the helix); where only ABC moves, degrees of the fastest rotary
/// axis.
struct PlannedMove {
    Move move;
    Point start = {};
    double length = 0;            ///< mm or degrees, > 0; 0 for a dwell
    double entry_velocity = 0;    ///< speed at the start, per second
    double cruise_velocity = 0;   ///< top speed reached or allowed, per second
    double exit_velocity = 0;     ///< speed at the end, per second
    double accel = 0;             ///< along the path, per second squared, both ways
    bool constant_accel = false;  ///< the speed changes evenly from `entry` to `exit` over the whole length
    std::uint8_t axes = 0;  ///< that move on the whole of a path that this is a piece of, a bit each, X the lowest; 0:
                            ///< those that move here
    std::int64_t number = 0;  ///< of the first move in it, in the order of push, from 0
    std::int32_t moves = 1;   ///< of the path that it stands for: short ones in one line
    double jerk =
        0;  ///< along the path, per second cubed; used for S-curves where the move starts and ends at rest; 0: none
};

}  // namespace motionrack::control
