// Lower bound on the duration of a curve: acceleration may change at once.
//
//   w, the square of the velocity, over u             back:  from the end, the highest w that can still be braked
//      ╭──╲        ╱──╮       caps: feed and axis     ahead: from the beginning, the highest w below that
//     ╱    ╲______╱    ╲      velocities              ╱ ╲:   |p' w'/2 + p'' w| <= the axis' acceleration
//
// On each cell w is linear, which is constant acceleration along u.
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <span>

namespace motionrack::control {

/// Returns the minimum duration in s from standstill to standstill along a curve, within the axes' velocity and
/// acceleration limits and the feed rates. Jerk is not limited. No jerk-limited motion along this curve is faster. On
/// curved segments the relative error is about 0.001. Returns 0 without segments.
double min_duration_s(std::span<const CubicSegment> curve, const MachineLimits& limits);

}  // namespace motionrack::control
