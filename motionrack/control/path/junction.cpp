#include <algorithm>
#include <cmath>
#include <motionrack/control/path/junction.hpp>
#include <motionrack/control/rest_profiles.hpp>

namespace motionrack::control {

namespace {

constexpr double no_corner_limit = 1e300;
/// Number of bisections for velocities: durations are compared, not executed.
constexpr int corner_halvings = 12;

/// Returns the largest velocity in min .. max for which distance(velocity), an increasing function, is at most
/// `length`.
template <class Distance>
double find_max_velocity(double min, double max, double length, Distance distance) {
    if (distance(max) <= length) return max;
    for (int i = 0; i < corner_halvings; ++i) {
        const double middle = 0.5 * (min + max);
        (distance(middle) < length ? min : max) = middle;
    }
    return min;
}

/// A passed end of a leg.
struct Side {
    double velocity = 0, half_blend_length = 0;
};
Side side_at(const Junction& junction, bool stops, const LegLimits& leg) {
    if (stops) return {};
    return {std::min(junction.velocity, leg.velocity),
            junction.velocity < leg.velocity ? junction.half_blend_length : 0};
}

/// Returns the minimum of limit / |tangent| over the axes, and of `min_limit`.
template <class LimitOf>
double min_along(const Point& tangent, double min_limit, LimitOf limit_of) {
    for (std::size_t i = 0; i < tangent.size(); ++i)
        if (tangent[i] != 0) min_limit = std::min(min_limit, limit_of(i) / std::fabs(tangent[i]));
    return min_limit;
}

}  // namespace

double ramp_duration_s(double more, const LegLimits& leg) {
    const double full = leg.accel * leg.accel / leg.jerk;
    return more > full ? more / leg.accel + leg.accel / leg.jerk : 2 * std::sqrt(more / leg.jerk);
}

double max_velocity_along(const Point& tangent, const MachineLimits& limits) {
    return min_along(tangent, no_corner_limit, [&](std::size_t i) { return limits[i].max_velocity; });
}

double max_accel_along(const Point& tangent, const MachineLimits& limits) {
    return min_along(tangent, no_corner_limit, [&](std::size_t i) { return limits[i].max_accel; });
}

double max_jerk_along(const Point& tangent, const MachineLimits& limits) {
    return min_along(tangent, no_corner_limit, [&](std::size_t i) { return effective_jerk(limits[i]); });
}

// The tangent changes as two parabolas: its maximum rate is 2 changes over the blend length, the second rate 4 over its
// square.
Junction junction_between(const LegLimits& before, const LegLimits& after, const Point& in, const Point& out,
                          double width, const MachineLimits& limits) {
    Point change;
    for (std::size_t i = 0; i < change.size(); ++i) change[i] = out[i] - in[i];
    const double by_accel = std::sqrt(0.5 * max_curvature_share * width * max_accel_along(change, limits));
    const double by_jerk = cube_root(0.25 * max_curvature_share * width * width * max_jerk_along(change, limits));
    Junction junction;
    junction.can_pass = true;
    junction.velocity = std::min(by_accel, by_jerk);
    junction.can_stop = junction.velocity < std::max(before.velocity, after.velocity);
    junction.half_blend_length = 0.5 * width;
    return junction;
}

double leg_duration_s(const LegLimits& leg, const Junction& begin, bool stops_at_begin, const Junction& end,
                      bool stops_at_end) {
    Side low = side_at(begin, stops_at_begin, leg), high = side_at(end, stops_at_end, leg);
    if (low.velocity > high.velocity) std::swap(low, high);
    const double rest = std::max(0.0, leg.length - low.half_blend_length - high.half_blend_length);
    const double gain = 0.5 * ((stops_at_begin ? begin.gain : 0) + (stops_at_end ? end.gain : 0));
    const auto distance_between = [&](double from, double to) {
        return 0.5 * (from + to) * ramp_duration_s(to - from, leg);
    };
    const auto turn_seconds = [](const Side& side) {
        return side.half_blend_length > 0 ? side.half_blend_length / side.velocity : 0;
    };
    double seconds = turn_seconds(low) - gain;
    if (distance_between(low.velocity, high.velocity) > rest) {
        high.velocity = find_max_velocity(low.velocity, high.velocity, rest,
                                          [&](double to) { return distance_between(low.velocity, to); });
        return high.velocity > 0 ? seconds + turn_seconds(high) + ramp_duration_s(high.velocity - low.velocity, leg)
                                 : no_corner_limit;
    }
    seconds += turn_seconds(high);
    const auto distances = [&](double top) {
        return distance_between(low.velocity, top) + distance_between(high.velocity, top);
    };
    const double top = find_max_velocity(high.velocity, leg.velocity, rest, distances);
    if (top > 0)
        seconds += ramp_duration_s(top - low.velocity, leg) + ramp_duration_s(top - high.velocity, leg) +
                   std::max(0.0, rest - distances(top)) / top;
    return seconds;
}

}  // namespace motionrack::control
