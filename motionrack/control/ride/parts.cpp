#include <algorithm>
#include <cmath>
#include <motionrack/control/ride/parts.hpp>
#include <motionrack/control/ride/piece_limits.hpp>

namespace motionrack::control {

namespace {

/// So much of an axis' acceleration the bend's share may change within a part.
constexpr double much_of_a_part = 0.1;
/// No part is shorter than this part of the time in which acceleration is reached, nor than these seconds allow.
constexpr double part_of_rise = 0.5;
constexpr double least_seconds = 0.0002, most_seconds = 0.004;
constexpr double most_parts = 64;

}  // namespace

CurvePiece part_of(const CurvePiece& piece, double from, double to) {
    CurvePiece out = piece;
    out.begin = piece.begin + from;
    out.length = to - from;
    out.start = position_on(piece, from);
    out.tangent = tangent_on(piece, from);
    out.bend = bend_on(piece, from);
    return out;
}

int parts_of(const CurvePiece& piece, const MachineLimits& limits) {
    if (is_straight(piece)) return 1;
    const PieceLimits on(piece, limits);
    double bend = 0, tangent = 0, change = 0, rise = most_seconds / part_of_rise;
    for (std::size_t i = 0; i < on.count; ++i) {
        const AxisOnPiece& axis = on.axes[i];
        bend = std::max(bend, axis.bend);
        tangent = std::max(tangent, axis.tangent);
        if (axis.jerk_bend > 0) change = std::max(change, axis.jerk_twist * axis.bend / axis.jerk_bend * piece.length);
        rise = std::min(rise, axis.jerk_tangent / axis.tangent);
    }
    const double speed = on.most_speed(share_of_a_bend), square = speed * speed;
    if (bend * square <= much_of_a_part) return 1;
    const double wanted = std::max(2 * bend * piece.length / tangent, change * square) / much_of_a_part;
    const double most = piece.length / (speed * std::max(least_seconds, part_of_rise * rise));
    return static_cast<int>(std::clamp(std::ceil(std::min(wanted, most)), 1.0, most_parts));
}

}  // namespace motionrack::control
