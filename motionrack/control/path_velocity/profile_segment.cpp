// Power series instead of hyperbolic and circular functions: cells are short, so a few terms suffice, and every
// compiler computes the same sums.
#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>

namespace motionrack::control {

namespace {

/// Each step squares the relative error, so no error is left after a step of this relative size.
constexpr double settled_part = 1e-10;
constexpr double feed_rounding = 4e-16;
/// Beside a standstill velocity2 may be rounded to 0. Its last digit is this share of the velocity.
constexpr double as_good_as_rest = 1e-8;

constexpr int max_terms = 60;
/// Factors from one term of a series to the next.
struct Factors {
    std::array<double, max_terms> sine = {}, cosine = {};
};
constexpr Factors factors = [] {
    Factors out;
    for (int k = 1; k < max_terms; ++k) {
        const auto i = static_cast<std::size_t>(k);
        out.sine[i] = 1 / (2.0 * k * (2 * k + 1));
        out.cosine[i] = 1 / ((2.0 * k + 1) * (2 * k + 2));
    }
    return out;
}();

/// sinh(q)/q and (cosh(q) - 1)/(q^2/2) for q^2 = `square`, which may be negative (then sin and cos).
struct Series {
    double sine, cosine;
};
Series series_of(double square) {
    Series out{1, 1};
    double sine = 1, cosine = 1;
    for (std::size_t k = 1; k < max_terms; ++k) {
        sine *= square * factors.sine[k];
        cosine *= square * factors.cosine[k];
        out.sine += sine;
        out.cosine += cosine;
        if (std::fabs(sine) < 1e-18) break;  // the other one is smaller
    }
    return out;
}

/// The motion on a cell at an instant. `position`: path length from the beginning of the cell.
struct CellMotion {
    double position;
    bool is_reversed;  ///< the motion has turned back: it may reach a position twice, or never reach the end
};
/// Returns the motion `time` s after the start of a cell. With negative curvature the motion is an oscillation, and
/// `time` is at most half of its period.
CellMotion motion_after(const ProfileSegment& cell, double velocity, double time) {
    const double square = 0.5 * cell.velocity2_curvature * time * time;
    const Series series = series_of(square);
    const double position = velocity * time * series.sine + 0.25 * cell.velocity2_slope * time * time * series.cosine;
    const double now = velocity * (1 + 0.5 * square * series.cosine) + 0.5 * cell.velocity2_slope * time * series.sine;
    return {position, !(now > 0) || position < 0};
}

double square_at(const ProfileSegment& cell, double x) {
    return std::max(0.0, cell.velocity2 + x * (cell.velocity2_slope + 0.5 * cell.velocity2_curvature * x));
}

}  // namespace

ProfileSegment approximate_parabolic_segment(double begin, double length, double square, double slope,
                                             double curvature) {
    ProfileSegment cell{ProfileSegmentKind::parabolic, begin, length, 0, square, slope, curvature, 0};
    cell.seconds = 2 * length / (std::sqrt(square) + std::sqrt(square_at(cell, length)));
    return cell;
}

ProfileSegment parabolic_segment(double begin, double length, double square, double slope, double curvature) {
    ProfileSegment cell = approximate_parabolic_segment(begin, length, square, slope, curvature);
    settle(cell);
    return cell;
}

void settle(ProfileSegment& cell) {
    if (cell.kind != ProfileSegmentKind::parabolic) return;
    const double length = cell.length, slope = cell.velocity2_slope, curvature = cell.velocity2_curvature;
    const double velocity = std::sqrt(cell.velocity2), end = std::sqrt(square_at(cell, length));
    // It is slower than at both ends only if it decelerates first and accelerates again.
    const bool dips = slope < 0 && curvature > 0 && -slope < curvature * length;
    const double min_velocity = dips ? std::sqrt(square_at(cell, -slope / curvature)) : std::min(velocity, end);
    double min_time = 0, max_time = length / std::max(min_velocity, as_good_as_rest * std::max(velocity, end));
    if (curvature < 0) max_time = std::min(max_time, pi / std::sqrt(-0.5 * curvature));  // half of a period
    double time = std::min(max_time, cell.seconds);
    for (int step = 0; step < 60; ++step) {
        const auto [there, is_reversed] = motion_after(cell, velocity, time);
        (there < length && !is_reversed ? min_time : max_time) = time;
        double next = time + (length - there) / std::sqrt(square_at(cell, std::clamp(there, 0.0, length)));
        const bool is_close = std::fabs(next - time) <= settled_part * time;
        // Where the motion is reversed, it is close to the end on its way back.
        const bool inside = next > min_time && next < max_time && !(is_close && is_reversed);
        if (!inside) next = 0.5 * (min_time + max_time);
        const bool settled = std::fabs(next - time) <= (inside ? settled_part : feed_rounding) * time;
        time = next;
        if (settled) break;
    }
    cell.seconds = time;
}

ProfileSegment constant_jerk_segment(double begin, double length, double seconds, double velocity, double accel,
                                     double jerk) {
    return {ProfileSegmentKind::constant_jerk, begin, length, seconds, velocity * velocity, 2 * accel, 0, jerk};
}

// velocity = jerk t^2/2, length = jerk t^3/6
ProfileSegment from_rest_segment(double begin, double length, double square) {
    const double velocity = std::sqrt(square), seconds = 3 * length / velocity;
    return {ProfileSegmentKind::from_rest, begin, length, seconds, 0, 0, 0, 2 * velocity / (seconds * seconds)};
}

ProfileSegment to_rest_segment(double begin, double length, double square) {
    ProfileSegment out = from_rest_segment(begin, length, square);
    out.kind = ProfileSegmentKind::to_rest;
    return out;
}

PathMotion ProfileSegment::at(double time) const {
    if (kind == ProfileSegmentKind::from_rest)
        return {begin + jerk * time * time * time / 6, jerk * time * time / 2, jerk * time, jerk};
    if (kind == ProfileSegmentKind::to_rest) {
        const double left = seconds - time;
        return {begin + length - jerk * left * left * left / 6, jerk * left * left / 2, -jerk * left, jerk};
    }
    if (kind == ProfileSegmentKind::constant_jerk) {
        const double velocity = std::sqrt(velocity2), accel = 0.5 * velocity2_slope;
        return {begin + time * (velocity + time * (0.5 * accel + time * (1.0 / 6) * jerk)),
                velocity + time * (accel + 0.5 * time * jerk), accel + time * jerk, jerk};
    }
    const double x = std::clamp(motion_after(*this, std::sqrt(velocity2), time).position, 0.0, length);
    const double velocity = std::sqrt(square_at(*this, x));
    return {begin + x, velocity, 0.5 * (velocity2_slope + velocity2_curvature * x),
            0.5 * velocity2_curvature * velocity};
}

PathMotion ProfileSegment::last() const {
    if (kind != ProfileSegmentKind::parabolic) return at(seconds);
    const double velocity = std::sqrt(square_at(*this, length));
    return {begin + length, velocity, 0.5 * (velocity2_slope + velocity2_curvature * length),
            0.5 * velocity2_curvature * velocity};
}

}  // namespace motionrack::control
