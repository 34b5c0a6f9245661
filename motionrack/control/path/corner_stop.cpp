#include <algorithm>
#include <cmath>
#include <motionrack/control/path/corner_stop.hpp>
#include <motionrack/control/rest_profiles.hpp>

namespace motionrack::control {

namespace {

constexpr double stop_rounding = 1e-9;
/// Maximum share of an axis' jerk for each of the two legs.
constexpr double max_share = 0.5;
/// Ratio of the reduced-jerk length to the overlap.
constexpr double spare = 1.1;
/// Minimum gain, relative to the duration of a leg, for a jerk reduction: a leg whose velocity the jerk changes is not
/// quite time-optimal.
constexpr double worth_easing = 0.01;
/// Smallest share of the tolerance that is tried.
constexpr double min_tolerance_share = 0.05;

/// Returns the time in which a leg from standstill only accelerates: to its velocity, or to its middle, s.
double rising_seconds(const LegLimits& leg) {
    const double full = leg.accel / leg.jerk, by_jerk = cube_root(4 * leg.length / leg.jerk);
    const double to_middle =
        by_jerk > 2 * full ? 0.5 * full + std::sqrt(0.25 * full * full + leg.length / leg.accel) : by_jerk;
    return std::min(ramp_duration_s(leg.velocity, leg), to_middle);
}

/// Returns the time in which the acceleration of a leg from standstill rises, s.
double rise_of(const LegLimits& leg) {
    return std::min(leg.accel / leg.jerk, 0.5 * rising_seconds(leg));
}

/// Returns the time until a leg from standstill has covered a distance, limited to its acceleration phase, s.
double leg_seconds_over(double distance, const LegLimits& leg) {
    const double rise = rise_of(leg), left = distance - leg.jerk * rise * rise * rise / 6;
    if (left <= 0) return cube_root(6 * distance / leg.jerk);
    const double accel = leg.jerk * rise, velocity = 0.5 * accel * rise;
    return std::min(rising_seconds(leg),
                    rise + 2 * left / (velocity + std::sqrt(velocity * velocity + 2 * accel * left)));
}

LegLimits eased(LegLimits leg, double share) {
    leg.jerk *= share;
    return leg;
}

/// Returns the share of the jerk for an axis that reverses and so has the acceleration of both legs. With it they
/// overlap for as long as the tolerance allows, within the axis limits.
double share_turning_back(const LegLimits& leg, double corner_tolerance_mm) {
    const double jerk = 0.5 * leg.accel / cube_root(6 * corner_tolerance_mm);
    return jerk * std::sqrt(jerk) / leg.jerk;
}

/// Returns the jerk reduction of a leg to this share of the jerk, for an overlap of `seconds`.
JerkReduction ease_for(const LegLimits& leg, double share, double seconds) {
    return {std::min(spare * share * leg.jerk * seconds * seconds * seconds / 6, 0.5 * leg.length), share};
}

/// Returns the time that a leg loses by a jerk reduction, at its maximum velocity, s. A launch with constant
/// acceleration is described by the time and position at which it would start without jerk limit.
double cost_of(const JerkReduction& ease, const LegLimits& leg) {
    const double jerk = leg.jerk * ease.share, first = cube_root(6 * ease.length / jerk), slow = jerk * first;
    const double accel = std::max(slow, leg.jerk * rise_of(leg)), second = (accel - slow) / leg.jerk;
    const double velocity_then = 0.5 * slow * first, velocity = velocity_then + 0.5 * (slow + accel) * second;
    const double distance = ease.length + second * (velocity_then + second * (0.5 * slow + second * leg.jerk / 6));
    const double rise = accel / leg.jerk;
    const double later = first + second - velocity / accel - 0.5 * rise,
                 nearer = accel * rise * rise / 24 - (distance - 0.5 * velocity * velocity / accel);
    const double all_of_it =
        (rising_seconds(eased(leg, ease.share)) - rising_seconds(leg)) * 2 * ease.length / leg.length;
    return std::max(all_of_it, later + nearer / std::max(velocity, accel * (rising_seconds(leg) - rise)));
}

double max_overlap_s(const LegLimits& before, const LegLimits& after, double corner_tolerance_mm) {
    return std::min({rising_seconds(before), rising_seconds(after),
                     leg_seconds_over(corner_tolerance_mm, before) + leg_seconds_over(corner_tolerance_mm, after)});
}

CornerStop eased_stop(const LegLimits& before, const LegLimits& after, double corner_tolerance_mm, bool turns_back) {
    double share = max_share;
    if (turns_back)
        share = std::min(
            {share, share_turning_back(before, corner_tolerance_mm), share_turning_back(after, corner_tolerance_mm)});
    const double seconds = max_overlap_s(eased(before, share), eased(after, share), corner_tolerance_mm);
    const JerkReduction ease_before = ease_for(before, share, seconds), ease_after = ease_for(after, share, seconds);
    return {seconds - cost_of(ease_before, before) - cost_of(ease_after, after), ease_before, ease_after};
}

}  // namespace

CornerStop corner_stop_between(const LegLimits& before, const LegLimits& after, const Point& in, const Point& out,
                               double corner_tolerance_mm, const MachineLimits& limits) {
    CornerStop stop;
    if (!(corner_tolerance_mm > 0)) return stop;
    bool shared = false, turns_back = false, too_much = false;
    for (std::size_t i = 0; i < limits.size(); ++i) {
        if (in[i] == 0 || out[i] == 0) continue;
        shared = true;
        turns_back = turns_back || in[i] * out[i] < 0;
        too_much = too_much || std::fabs(before.jerk * in[i] + after.jerk * out[i]) >
                                   effective_jerk(limits[i]) * (1 + stop_rounding);
    }
    if (!too_much) {
        stop.gain = max_overlap_s(before, after, corner_tolerance_mm);
        // Beyond this, an axis that reverses would have the acceleration of both legs.
        if (shared) stop.gain = std::min({stop.gain, rise_of(before), rise_of(after)});
        return stop;
    }
    for (double tolerance = corner_tolerance_mm; tolerance > corner_tolerance_mm * min_tolerance_share;
         tolerance *= 0.5) {
        const CornerStop eased = eased_stop(before, after, tolerance, turns_back);
        if (eased.gain > stop.gain) stop = eased;
    }
    if (stop.gain < worth_easing * (rising_seconds(before) + rising_seconds(after))) stop = {};
    return stop;
}

}  // namespace motionrack::control
