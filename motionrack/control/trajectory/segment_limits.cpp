#include <algorithm>
#include <cmath>
#include <motionrack/control/path/junction.hpp>
#include <motionrack/control/rest_profiles.hpp>
#include <motionrack/control/trajectory/segment_limits.hpp>

namespace motionrack::control {

namespace {

/// Maximum share of an axis' acceleration and jerk for the curvature; the rest changes the velocity.
constexpr double max_accel_share = 0.995, max_jerk_share = 0.97;
/// Share of the remaining jerk for changing the velocity on a curve; the rest changes the acceleration.
constexpr double curvature_share = 0.7;
constexpr double no_limit = 1e300;

struct Range {
    double min, max;
    double magnitude() const { return std::max(-min, max); }
};

/// Returns the range of a tangent over the segment: a parabola, with its extremes at the ends or the vertex.
Range tangents_of(double tangent, double curvature, double curvature_rate, double length) {
    const double end = tangent + length * (curvature + 0.5 * curvature_rate * length);
    Range out{std::min(tangent, end), std::max(tangent, end)};
    const double summit = curvature_rate != 0 ? -curvature / curvature_rate : -1;
    if (summit > 0 && summit < length) {
        const double there = tangent + 0.5 * curvature * summit;
        out = {std::min(out.min, there), std::max(out.max, there)};
    }
    return out;
}

AxisSegmentLimits axis_on(const CubicSegment& piece, const AxisLimits& limits, std::size_t i, const Range& tangents) {
    const double end = piece.curvature[i] + piece.curvature_rate[i] * piece.length;
    const Range curvatures{std::min(piece.curvature[i], end), std::max(piece.curvature[i], end)};
    // Curvature with the sign of the tangent reduces the available acceleration; with the opposite sign the
    // deceleration.
    const bool with = (tangents.max > 0 && curvatures.max > 0) || (tangents.min < 0 && curvatures.min < 0);
    const bool against = (tangents.max > 0 && curvatures.min < 0) || (tangents.min < 0 && curvatures.max > 0);
    const double tangent = tangents.magnitude(), curvature = curvatures.magnitude(),
                 jerk = piece.jerk_share * effective_jerk(limits);
    AxisSegmentLimits axis;
    axis.tangent = tangent / limits.max_accel;
    axis.curvature = curvature / limits.max_accel;
    axis.curvature_up = with ? axis.curvature : 0;
    axis.curvature_down = against ? axis.curvature : 0;
    axis.jerk_tangent = tangent / jerk;
    axis.jerk_curvature = curvature / jerk;
    axis.jerk_curvature_rate = std::fabs(piece.curvature_rate[i]) / jerk;
    return axis;
}

}  // namespace

SegmentLimits::SegmentLimits(const CubicSegment& piece, const MachineLimits& limits) : velocity(piece.feed) {
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const Range tangents = tangents_of(piece.tangent[i], piece.curvature[i], piece.curvature_rate[i], piece.length);
        if (tangents.magnitude() == 0) continue;
        const AxisSegmentLimits axis = axes[count++] = axis_on(piece, limits[i], i, tangents);
        velocity = std::min(velocity, limits[i].max_velocity / tangents.magnitude());
        if (axis.curvature > 0) velocity = std::min(velocity, std::sqrt(max_accel_share / axis.curvature));
        curvature_rate = std::max(curvature_rate, axis.jerk_curvature_rate);
        straight = straight && axis.curvature == 0 && axis.jerk_curvature_rate == 0;
    }
}

double SegmentLimits::max_velocity_for(double jerk_share) const {
    return curvature_rate > 0 ? std::min(velocity, cube_root(jerk_share / curvature_rate)) : velocity;
}

double SegmentLimits::jerk_share_beside(double at_velocity, double accel, double jerk) const {
    double share = max_jerk_share;
    for (std::size_t i = 0; i < count; ++i) {
        const double by_curvature = 3 * axes[i].jerk_curvature * at_velocity * accel;
        share =
            std::min(share, 1 - std::max(axes[i].jerk_tangent * jerk + by_curvature, by_curvature / curvature_share));
    }
    return std::max(share, max_curvature_share);
}

LimitInterval SegmentLimits::up_to(double top, double length) const {
    LimitInterval out{length, top, no_limit, no_limit, no_limit};
    const double square = out.velocity * out.velocity;
    for (std::size_t i = 0; i < count; ++i) {
        const AxisSegmentLimits& axis = axes[i];
        const double by_curvature = axis.curvature > 0
                                        ? curvature_share * (1 - axis.jerk_curvature_rate * square * out.velocity) /
                                              (3 * axis.jerk_curvature * out.velocity)
                                        : no_limit;
        out.accel = std::min({out.accel, by_curvature, (1 - axis.curvature_up * square) / axis.tangent});
        out.brake = std::min({out.brake, by_curvature, (1 - axis.curvature_down * square) / axis.tangent});
    }
    const double accel = std::max(out.accel, out.brake);
    for (std::size_t i = 0; i < count; ++i) {
        const AxisSegmentLimits& axis = axes[i];
        out.jerk = std::min(out.jerk, (1 - axis.jerk_curvature_rate * square * out.velocity -
                                       3 * axis.jerk_curvature * out.velocity * accel) /
                                          axis.jerk_tangent);
    }
    return out;
}

/// Returns the highest velocity2 reachable within `length`, w1 from w0 = `square`: w1 - w0 = 2 length (1 - curvature
/// w1) / tangent, for the most limited axis.
double SegmentLimits::compute_reachable_velocities(double square, double length,
                                                   double AxisSegmentLimits::*curvature) const {
    double max_square = no_limit;
    for (std::size_t i = 0; i < count; ++i)
        max_square = std::min(
            max_square, (axes[i].tangent * square + 2 * length) / (axes[i].tangent + 2 * length * axes[i].*curvature));
    return max_square;
}

}  // namespace motionrack::control
