#include <algorithm>
#include <cmath>
#include <motionrack/control/trajectory/segment_limits.hpp>
#include <motionrack/control/trajectory/subdivide.hpp>

namespace motionrack::control {

namespace {

/// Largest change of the curvature's share of an axis' acceleration within a part.
constexpr double much_of_a_part = 0.1;
/// Minimum duration of a part: a share of the time to reach the acceleration, and these seconds.
constexpr double part_of_rise = 0.5;
constexpr double min_seconds = 0.0002, max_seconds = 0.004;
constexpr double max_parts = 64;

}  // namespace

CubicSegment sub_move(const CubicSegment& piece, double from, double to) {
    CubicSegment out = piece;
    out.begin = piece.begin + from;
    out.length = to - from;
    out.start = position_on(piece, from);
    out.tangent = tangent_on(piece, from);
    out.curvature = curvature_on(piece, from);
    return out;
}

int subdivision_count(const CubicSegment& piece, const MachineLimits& limits) {
    if (is_straight(piece)) return 1;
    const SegmentLimits on(piece, limits);
    double curvature = 0, tangent = 0, change = 0, rise = max_seconds / part_of_rise;
    for (std::size_t i = 0; i < on.count; ++i) {
        const AxisSegmentLimits& axis = on.axes[i];
        curvature = std::max(curvature, axis.curvature);
        tangent = std::max(tangent, axis.tangent);
        if (axis.jerk_curvature > 0)
            change = std::max(change, axis.jerk_curvature_rate * axis.curvature / axis.jerk_curvature * piece.length);
        rise = std::min(rise, axis.jerk_tangent / axis.tangent);
    }
    const double velocity = on.max_velocity_for(max_curvature_share), square = velocity * velocity;
    if (curvature * square <= much_of_a_part) return 1;
    const double wanted = std::max(2 * curvature * piece.length / tangent, change * square) / much_of_a_part;
    const double max_count = piece.length / (velocity * std::max(min_seconds, part_of_rise * rise));
    return static_cast<int>(std::clamp(std::ceil(std::min(wanted, max_count)), 1.0, max_parts));
}

}  // namespace motionrack::control
