#include <motionrack/control/curve/corner.hpp>

#include <algorithm>
#include <cmath>
#include <motionrack/control/profile.hpp>

namespace motionrack::control {

namespace {

/// From one speed to another that is `more`, without acceleration at both.
double ramp_seconds(double more, const CornerSide& side) {
    const double full = side.accel * side.accel / side.jerk;
    return more > full ? more / side.accel + side.accel / side.jerk : 2 * std::sqrt(more / side.jerk);
}

/// Over `length`, with the same speed at both ends and no acceleration there.
double leg_seconds(double length, double end, const CornerSide& side) {
    if (length <= 0) return 0;
    const auto ways = [&](double top) { return (end + top) * ramp_seconds(top - end, side); };
    const double top = side.speed;
    if (top <= end) return length / end;
    if (const double way = ways(top); way <= length) return 2 * ramp_seconds(top - end, side) + (length - way) / top;
    double least = end, most = top;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (least + most);
        (ways(middle) < length ? least : most) = middle;
    }
    return 2 * ramp_seconds(least - end, side);
}

// The tangent changes as two parabolas: its greatest rate is 2 changes over the width, the rate's rate is 4 over its square.
double corner_speed(const Corner& corner) {
    const double by_accel = std::sqrt(share_of_a_bend * corner.width / (2 * corner.per_accel));
    const double by_jerk = corner.per_jerk > 0 ? cube_root(share_of_a_bend * corner.width * corner.width / (4 * corner.per_jerk)) : by_accel;
    return std::min({by_accel, by_jerk, corner.sides[0].speed, corner.sides[1].speed});
}

}  // namespace

bool is_better_passed(const Corner& corner) {
    const double speed = corner_speed(corner);
    if (!(speed > 0)) return false;
    double passed = corner.width / speed, stopped = 0;
    for (const CornerSide& side : corner.sides) {
        passed += 0.5 * leg_seconds(side.length - corner.width, speed, side);
        stopped += 0.5 * leg_seconds(side.length, 0, side);
    }
    return passed < stopped;
}

}  // namespace motionrack::control
