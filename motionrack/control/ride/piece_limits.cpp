#include <algorithm>
#include <cmath>
#include <motionrack/control/curve/corner.hpp>
#include <motionrack/control/profile.hpp>
#include <motionrack/control/ride/piece_limits.hpp>

namespace motionrack::control {

namespace {

/// Of an axis' acceleration and of its jerk a bend takes this much at most; the rest changes the speed.
constexpr double accel_of_bend = 0.995, most_jerk_of_bend = 0.97;
/// Of what jerk is left, changing the speed on a bend takes so much; the rest changes the acceleration.
constexpr double share_of_bend = 0.7;
constexpr double no_limit = 1e300;

struct Range {
    double least, most;
    double greatest() const { return std::max(-least, most); }
};

/// Of a tangent over the piece: a parabola, whose ends or whose summit it is.
Range tangents_of(double tangent, double bend, double twist, double length) {
    const double end = tangent + length * (bend + 0.5 * twist * length);
    Range out{std::min(tangent, end), std::max(tangent, end)};
    const double summit = twist != 0 ? -bend / twist : -1;
    if (summit > 0 && summit < length) {
        const double there = tangent + 0.5 * bend * summit;
        out = {std::min(out.least, there), std::max(out.most, there)};
    }
    return out;
}

AxisOnPiece axis_on(const CurvePiece& piece, const AxisLimits& limits, std::size_t i, const Range& tangents) {
    const double end = piece.bend[i] + piece.twist[i] * piece.length;
    const Range bends{std::min(piece.bend[i], end), std::max(piece.bend[i], end)};
    // With the tangent's sign a bend takes from speeding up; against it from slowing down.
    const bool with = (tangents.most > 0 && bends.most > 0) || (tangents.least < 0 && bends.least < 0);
    const bool against = (tangents.most > 0 && bends.least < 0) || (tangents.least < 0 && bends.most > 0);
    const double tangent = tangents.greatest(), bend = bends.greatest(), jerk = piece.jerk_share * jerk_of(limits);
    AxisOnPiece axis;
    axis.tangent = tangent / limits.max_accel;
    axis.bend = bend / limits.max_accel;
    axis.bend_up = with ? axis.bend : 0;
    axis.bend_down = against ? axis.bend : 0;
    axis.jerk_tangent = tangent / jerk;
    axis.jerk_bend = bend / jerk;
    axis.jerk_twist = std::fabs(piece.twist[i]) / jerk;
    return axis;
}

}  // namespace

PieceLimits::PieceLimits(const CurvePiece& piece, const MachineLimits& limits) : speed(piece.feed) {
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const Range tangents = tangents_of(piece.tangent[i], piece.bend[i], piece.twist[i], piece.length);
        if (tangents.greatest() == 0) continue;
        const AxisOnPiece axis = axes[count++] = axis_on(piece, limits[i], i, tangents);
        speed = std::min(speed, limits[i].max_speed / tangents.greatest());
        if (axis.bend > 0) speed = std::min(speed, std::sqrt(accel_of_bend / axis.bend));
        twist = std::max(twist, axis.jerk_twist);
        straight = straight && axis.bend == 0 && axis.jerk_twist == 0;
    }
}

double PieceLimits::most_speed(double jerk_share) const {
    return twist > 0 ? std::min(speed, cube_root(jerk_share / twist)) : speed;
}

double PieceLimits::jerk_share_beside(double at_speed, double accel, double jerk) const {
    double share = most_jerk_of_bend;
    for (std::size_t i = 0; i < count; ++i) {
        const double bent = 3 * axes[i].jerk_bend * at_speed * accel;
        share = std::min(share, 1 - std::max(axes[i].jerk_tangent * jerk + bent, bent / share_of_bend));
    }
    return std::max(share, share_of_a_bend);
}

FeedSpan PieceLimits::up_to(double top, double length) const {
    FeedSpan out{length, top, no_limit, no_limit, no_limit};
    const double square = out.speed * out.speed;
    for (std::size_t i = 0; i < count; ++i) {
        const AxisOnPiece& axis = axes[i];
        const double bent = axis.bend > 0 ? share_of_bend * (1 - axis.jerk_twist * square * out.speed) /
                                                (3 * axis.jerk_bend * out.speed)
                                          : no_limit;
        out.accel = std::min({out.accel, bent, (1 - axis.bend_up * square) / axis.tangent});
        out.brake = std::min({out.brake, bent, (1 - axis.bend_down * square) / axis.tangent});
    }
    const double accel = std::max(out.accel, out.brake);
    for (std::size_t i = 0; i < count; ++i) {
        const AxisOnPiece& axis = axes[i];
        out.jerk =
            std::min(out.jerk, (1 - axis.jerk_twist * square * out.speed - 3 * axis.jerk_bend * out.speed * accel) /
                                   axis.jerk_tangent);
    }
    return out;
}

/// From w0 to w1, the greater one: w1 - w0 = 2 length (1 - bend w1) / tangent, for the axis that has least.
double PieceLimits::reach(double square, double length, double AxisOnPiece::*bend) const {
    double most = no_limit;
    for (std::size_t i = 0; i < count; ++i)
        most = std::min(most, (axes[i].tangent * square + 2 * length) / (axes[i].tangent + 2 * length * axes[i].*bend));
    return most;
}

}  // namespace motionrack::control
