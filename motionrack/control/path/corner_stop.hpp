// A stop at a corner whose tolerance lets the next leg start before the previous one has ended: the time gained and the
// jerk reduction required.
//
//   velocity  ╲         ╱     An axis of both legs has the jerk of both. Where the sum exceeds its limit, both legs
//              ╲▁_    _▁╱     use a share of their jerk near the corner.
//                 ▔──▔
//           reduced jerk
#pragma once

#include <motionrack/control/path/junction.hpp>

namespace motionrack::control {

/// Part at one end of a leg in which only a share of the jerk is used.
struct JerkReduction {
    double length = 0;  ///< length of the part, mm or degrees
    double share = 1;
};

struct CornerStop {
    double gain = 0;  ///< time gained by the overlap of both legs, s
    JerkReduction before, after;
};

/// Estimates the overlap that max_overlap_s() will find. `corner_tolerance_mm`: largest distance of the path from the
/// sides of the corner.
CornerStop corner_stop_between(const LegLimits& before, const LegLimits& after, const Point& in, const Point& out,
                               double corner_tolerance_mm, const MachineLimits& limits);

}  // namespace motionrack::control
