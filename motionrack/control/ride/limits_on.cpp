#include <motionrack/control/ride/limits_on.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/control/curve/corner.hpp>
#include <motionrack/control/profile.hpp>

namespace motionrack::control {

namespace {

/// Of what jerk is left, changing the speed on a bend takes so much; the rest changes the acceleration.
constexpr double share_of_bend = 0.7;
constexpr double no_limit = 1e300;
/// A bend leaves at least a little.
constexpr double most_share = 0.97;

/// The greatest absolute value of a tangent over the piece: a parabola, whose ends or whose summit it is.
double greatest_tangent(double tangent, double bend, double twist, double length) {
    const double end = tangent + length * (bend + 0.5 * twist * length);
    double most = std::max(std::fabs(tangent), std::fabs(end));
    const double summit = twist != 0 ? -bend / twist : -1;
    if (summit > 0 && summit < length) most = std::max(most, std::fabs(tangent + 0.5 * bend * summit));
    return most;
}

/// Greatest absolute values over the piece, and the axis' limits.
struct AxisOnPiece {
    double tangent = 0, bend = 0, twist = 0, accel = 0, jerk = 0;
};

AxisOnPiece axis_on(const CurvePiece& piece, const MachineLimits& limits, std::size_t i) {
    AxisOnPiece axis;
    axis.tangent = greatest_tangent(piece.tangent[i], piece.bend[i], piece.twist[i], piece.length);
    axis.bend = std::max(std::fabs(piece.bend[i]), std::fabs(piece.bend[i] + piece.twist[i] * piece.length));
    axis.twist = std::fabs(piece.twist[i]);
    if (axis.tangent == 0 && axis.bend == 0) return axis;
    axis.accel = limits[i].max_accel;
    axis.jerk = piece.jerk_share * jerk_of(limits[i]);
    return axis;
}

}  // namespace

FeedSpan limits_on(const CurvePiece& piece, const MachineLimits& limits, double most_speed, const BendShares& shares) {
    std::array<AxisOnPiece, axis_count> axes;
    double speed = std::min(piece.feed, most_speed);
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisOnPiece axis = axes[i] = axis_on(piece, limits, i);
        if (axis.tangent > 0) speed = std::min(speed, limits[i].max_speed / axis.tangent);
        if (axis.bend > 0) speed = std::min(speed, std::sqrt(shares.accel * axis.accel / axis.bend));
        if (axis.twist > 0) speed = std::min(speed, cube_root(shares.jerk * axis.jerk / axis.twist));
    }
    FeedSpan out{piece.length, speed, no_limit, no_limit};
    const double square = speed * speed;
    for (const AxisOnPiece& axis : axes) {
        if (axis.tangent > 0) out.accel = std::min(out.accel, (axis.accel - axis.bend * square) / axis.tangent);
        if (axis.bend > 0) out.accel = std::min(out.accel, share_of_bend * (axis.jerk - axis.twist * square * speed) / (3 * axis.bend * speed));
    }
    for (const AxisOnPiece& axis : axes)
        if (axis.tangent > 0) out.jerk = std::min(out.jerk, (axis.jerk - axis.twist * square * speed - 3 * axis.bend * speed * out.accel) / axis.tangent);
    return out;
}

BendShares shares_beside(const CurvePiece& piece, const MachineLimits& limits, double speed, double accel, double jerk) {
    BendShares shares{most_share, most_share};
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const AxisOnPiece axis = axis_on(piece, limits, i);
        if (!(axis.accel > 0) || axis.bend == 0) continue;
        shares.accel = std::min(shares.accel, 1 - axis.tangent * accel / axis.accel);
        shares.jerk = std::min(shares.jerk, 1 - std::max(axis.tangent * jerk + 3 * axis.bend * speed * accel, 3 / share_of_bend * axis.bend * speed * accel) / axis.jerk);
    }
    return {std::max(shares.accel, share_of_a_bend), std::max(shares.jerk, share_of_a_bend)};
}

}  // namespace motionrack::control
