// Limits along a path and at its junctions, from reciprocals of the axis limits.

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/path_limits.hpp>

namespace motionrack::control {
namespace {

// squares: 0.64 + 0.16 < 1
constexpr double share_towards_centre = 0.8;
constexpr double share_along_arc = 0.4;

/// Replaces 1 / 0 and avoids 0 * infinity.
constexpr double no_limit_left = 1e200;

/// Junctions below this velocity (units a second, squared) are stops.
constexpr double min_junction_velocity2 = 1e-18;

double reciprocal(double limit) {
    return limit > 0 ? 1 / limit : no_limit_left;
}

double square(double x) {
    return x * x;
}

}  // namespace

bool is_same_direction(const Point& in, const Point& out) {
    const double linear = square(out[0] - in[0]) + square(out[1] - in[1]) + square(out[2] - in[2]);
    if (linear > square(tangent_angle_rad)) return false;
    const double rotary = square(out[3] - in[3]) + square(out[4] - in[4]) + square(out[5] - in[5]);
    if (rotary == 0) return true;
    const double size = std::max(
        {1.0, square(in[3]) + square(in[4]) + square(in[5]), square(out[3]) + square(out[4]) + square(out[5])});
    return rotary <= square(tangent_angle_rad) * size;
}

PathLimits::PathLimits(const MachineLimits& limits) {
    for (int i = 0; i < axis_count; ++i) {
        const AxisLimits& axis = limits[i];
        present_[i] = axis.present;
        per_velocity_[i] = reciprocal(axis.max_velocity);
        per_accel_[i] = reciprocal(axis.max_accel);
        per_jump_[i] = reciprocal(axis.max_velocity_step);
        per_jerk_[i] = axis.max_jerk > 0 ? 1 / axis.max_jerk : -1;
        any_jerk_ = any_jerk_ || axis.max_jerk > 0;
    }
}

int PathLimits::missing_axis(const Geometry& path) const {
    for (int i = 0; i < axis_count; ++i) {
        if (!present_[i] && (path.tangent_in[i] != 0 || path.tangent_out[i] != 0)) return i;
    }
    return -1;
}

AlongPathLimits PathLimits::along(const Geometry& path, const Move& move) const {
    const bool arc = path.shape == PathShape::arc;
    const Point components = max_tangent_components(path);
    double per_velocity = 0;
    double per_accel = 0;
    for (int i = 0; i < axis_count; ++i) {
        per_velocity = std::max(per_velocity, components[i] * per_velocity_[i]);
        const bool in_plane = arc && (i == path.first || i == path.second);
        if (!in_plane) per_accel = std::max(per_accel, components[i] * per_accel_[i]);
    }
    AlongPathLimits found;
    found.velocity = 1 / per_velocity;
    if (arc) {
        const double fraction = plane_fraction(path);
        const double per_plane_accel = std::max(per_accel_[path.first], per_accel_[path.second]);
        per_accel = std::max(per_accel, fraction * per_plane_accel / share_along_arc);
        const double pull_limit = share_towards_centre * path.radius / (per_plane_accel * fraction * fraction);
        found.velocity = std::min(found.velocity, std::sqrt(pull_limit));
    }
    found.accel = 1 / per_accel;
    if (move.kind == MoveKind::rapid) {
        found.velocity *= move.rapid_override;
    } else {
        found.velocity =
            std::min(found.velocity, move.feed_mode == FeedMode::inverse_time ? path.length * move.feed : move.feed);
    }
    if (any_jerk_ && !arc) {
        double per_jerk = 0;
        bool all = true;
        for (int i = 0; i < axis_count; ++i) {
            if (components[i] == 0) continue;
            all = all && per_jerk_[i] > 0;
            per_jerk = std::max(per_jerk, components[i] * per_jerk_[i]);
        }
        if (all) found.jerk = 1 / per_jerk;
    }
    return found;
}

double PathLimits::max_corner_velocity2(const Point& in, const Point& out, double mean_length,
                                        double tolerance_mm) const {
    double per_jump = 0;   // per unit of velocity
    double per_accel = 0;  // per unit of velocity squared, by length
    double per_corner = 0;
    double linear = 0;
    for (int i = 0; i < axis_count; ++i) {
        const double jump = std::fabs(out[i] - in[i]);
        per_jump = std::max(per_jump, jump * per_jump_[i]);
        per_accel = std::max(per_accel, jump * per_accel_[i]);
        if (i == 2) per_corner = per_accel;
        if (i < 3) linear += jump * jump;
    }
    double limit = std::min(1 / (per_jump * per_jump), mean_length / per_accel);
    if (linear > square(tangent_angle_rad)) {
        // linear = 4 cos^2(half the inner angle); s / (1 - s) = s (1 + s) / (1 - s^2)
        const double cos_squared = std::min(1.0, 0.25 * linear);
        const double s = std::sqrt(1 - cos_squared);
        const double accel = std::sqrt(linear) / per_corner;
        if (tolerance_mm < std::numeric_limits<double>::max())
            limit = std::min(limit, accel * tolerance_mm * s * (1 + s) / cos_squared);
    }
    return limit;
}

double PathLimits::max_junction_velocity2(const Geometry& before, double velocity_before, const Geometry& after,
                                          double velocity_after, PathControl path, double tolerance_mm) const {
    if (path == PathControl::exact_stop) return 0;
    if ((before.shape == PathShape::rotary) != (after.shape == PathShape::rotary)) return 0;
    double limit = square(std::min(velocity_before, velocity_after));
    if (!is_same_direction(before.tangent_out, after.tangent_in)) {
        if (path == PathControl::exact_path) return 0;
        const double mean_length = 0.5 * (before.length + after.length);
        limit = std::min(limit, max_corner_velocity2(before.tangent_out, after.tangent_in, mean_length, tolerance_mm));
    }
    return limit < min_junction_velocity2 ? 0 : limit;
}

}  // namespace motionrack::control
