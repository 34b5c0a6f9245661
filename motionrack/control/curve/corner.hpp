// A corner: driven through on a rounded path, or with a stop at its point?
#pragma once

#include <array>

namespace motionrack::control {

/// The greatest speed on a bend takes so much of an axis' acceleration across the path and of its jerk; the rest changes the speed.
inline constexpr double share_of_a_bend = 0.8;

/// One of the two moves that meet at a corner, and what the axes can do along it; mm or degrees, and s.
struct CornerSide {
    double length = 0;
    double speed = 0, accel = 0, jerk = 0;
};

struct Corner {
    std::array<CornerSide, 2> sides;
    double width = 0;      ///< over which the turn is spread
    double per_accel = 0;  ///< the change of direction, over what the axes can do; the greatest of them
    double per_jerk = 0;
};

/// Whether both moves, each with such a corner at either end, take less time through their corners than from stop to stop.
bool is_better_passed(const Corner& corner);

}  // namespace motionrack::control
