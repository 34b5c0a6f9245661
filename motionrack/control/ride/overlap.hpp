// A corner where one stretch ends and the next begins: within a tolerance the next one may begin a little before the one before it has ended.
//
//   speed  ╲               ╱            each axis' speed, acceleration and jerk is the sum of both
//     in    ╲▁           ▁╱  out        ──►  ╲▁╱▔   the corner is cut by at most the tolerance
//             ▔▔─────────▔▔
#pragma once

#include <motionrack/control/curve/curve.hpp>
#include <motionrack/control/feed/feed_piece.hpp>
#include <motionrack/control/limits.hpp>

namespace motionrack::control {

/// How a stretch ends or begins: with constant jerk, on a piece of its curve.
struct StretchEnd {
    CurvePiece curve;
    FeedPiece feed;
};

/// Seconds by which the next one may begin earlier; 0: none, as on curved ends, or where an axis of both would get too much jerk. `room_mm`:
/// how far the path may be from the corner's sides.
double overlap_of(const StretchEnd& in, const StretchEnd& out, double room_mm, const MachineLimits& limits);

}  // namespace motionrack::control
