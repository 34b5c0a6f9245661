// What the axes' limits mean for the speed along a curve.
#pragma once

#include <motionrack/control/curve/corner.hpp>
#include <motionrack/control/curve/curve.hpp>
#include <motionrack/control/feed/feed_span.hpp>
#include <motionrack/control/limits.hpp>

namespace motionrack::control {

/// How much of its acceleration and of its jerk an axis may need for the bend alone; 0 .. 1.
struct BendShares {
    double accel = share_of_a_bend;
    double jerk = share_of_a_bend;
};

inline constexpr double no_speed_limit = 1e300;

/// Speed, acceleration and jerk along a piece that no axis notices beyond its own: with v, a and j along the piece an axis has
///     p' v,   p' a + p'' v^2,   p' j + 3 p'' v a + p''' v^3.
/// Of an axis' acceleration and jerk the greatest speed leaves some for changing it.
/// The slower `most_speed`, the more is left.
FeedSpan limits_on(const CurvePiece& piece, const MachineLimits& limits, double most_speed = no_speed_limit, const BendShares& shares = {});

/// The greatest shares that leave what these take: `accel` and `jerk` along the piece, at `speed`; no less than a bend has anyway.
BendShares shares_beside(const CurvePiece& piece, const MachineLimits& limits, double speed, double accel, double jerk);

}  // namespace motionrack::control
