// A stop at a corner, of which the tolerance lets the next leg begin before the one before it has ended: what it wins,
// and what it needs.
//
//   speed  ╲         ╱       An axis of both legs gets the jerk of both. Where that is too much,
//           ╲▁_    _▁╱       both are eased about the corner: there they take a part of their jerk.
//              ▔──▔
//             eased
#pragma once

#include <motionrack/control/path/junction.hpp>

namespace motionrack::control {

/// The end of a leg on which it takes only a part of its jerk.
struct JerkReduction {
    double length = 0;  ///< mm or degrees
    double share = 1;
};

struct CornerStop {
    double gain = 0;  ///< s
    JerkReduction before, after;
};

/// About what max_overlap_s() will find; `corner_tolerance_mm`: how far the path may be from the corner's sides.
CornerStop corner_stop_between(const LegLimits& before, const LegLimits& after, const Point& in, const Point& out,
                               double corner_tolerance_mm, const MachineLimits& limits);

}  // namespace motionrack::control
