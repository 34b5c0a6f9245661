// How fast a curve could be driven if acceleration could change at once.
//
//   w, the square of the speed, over u                back:  from the end, how fast one may be here and still go on
//      ╭──╲        ╱──╮       caps: feed and axis     ahead: from the begin, as fast as can be below that
//     ╱    ╲______╱    ╲      speeds                  ╱ ╲:   |p' w'/2 + p'' w| <= the axis' acceleration
//
// On each cell w is a straight line, which is constant acceleration along u.
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <span>

namespace motionrack::control {

/// Seconds from rest to rest along a curve, as quick as each axis' speed and acceleration and the pieces' feeds allow;
/// jerk is not limited. No motion along this curve with a limited jerk is quicker. Of curves with bends it is found to
/// about a thousandth; 0: no pieces.
double min_duration_s(std::span<const CubicSegment> curve, const MachineLimits& limits);

}  // namespace motionrack::control
