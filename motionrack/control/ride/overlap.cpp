#include <motionrack/control/ride/overlap.hpp>

#include <algorithm>
#include <motionrack/control/curve/corner.hpp>

namespace motionrack::control {

double overlap_of(const StretchEnd& in, const StretchEnd& out, double room_mm, const MachineLimits& limits) {
    if (!is_straight(in.curve) || !is_straight(out.curve)) return 0;
    if (in.feed.length > in.curve.length || out.feed.length > out.curve.length) return 0;
    const double within = overlap_within(room_mm, in.feed.jerk, in.curve.tangent, out.feed.jerk, out.curve.tangent, limits);
    return std::min({in.feed.seconds, out.feed.seconds, within});
}

}  // namespace motionrack::control
