#include <motionrack/control/ride/overlap.hpp>

#include <algorithm>
#include <cmath>
#include <motionrack/control/profile.hpp>

namespace motionrack::control {

namespace {

constexpr double rounding = 1e-9;

}  // namespace

// With t from the next one's begin, the one before it has still jerk (T - t)^3 / 6 to go, and the next one has gone jerk t^3 / 6. The path is
// no farther from one side than it has gone along the other, so it is farthest where both are equal. Speeds and accelerations are greatest at
// the ends, where one of the two is 0.
double overlap_of(const StretchEnd& in, const StretchEnd& out, double room_mm, const MachineLimits& limits) {
    if (!(room_mm > 0) || !is_straight(in.curve) || !is_straight(out.curve)) return 0;
    if (in.feed.length > in.curve.length || out.feed.length > out.curve.length) return 0;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const double jerk = std::fabs(in.feed.jerk * in.curve.tangent[i] + out.feed.jerk * out.curve.tangent[i]);
        if (limits[i].max_jerk > 0 && jerk > limits[i].max_jerk * (1 + rounding)) return 0;
    }
    const double share = 1 + cube_root(in.feed.jerk / out.feed.jerk);
    return std::min({in.feed.seconds, out.feed.seconds, share * cube_root(6 * room_mm / in.feed.jerk)});
}

}  // namespace motionrack::control
