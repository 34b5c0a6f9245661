// Writes the solution as profile segments; with constant limits, the exact time-optimal profile.
#include <algorithm>
#include <cmath>
#include <motionrack/control/axis_profile/axis_profile.hpp>
#include <motionrack/control/path_velocity/velocity_planner.hpp>
#include <motionrack/control/rest_profiles.hpp>

namespace motionrack::control {

/// Writes the time-optimal profile for constant limits. Lengths come from durations and velocities of the phases,
/// because differences of positions have too few digits for short phases.
///
///   velocity v1 = jerk rise^2/2, v2 = v1 + accel even      length   jerk rise^3/6 │ even (v1 + v2)/2 │ ...
void VelocityPlanner::write_s_curve(const LimitInterval& limits) {
    const SCurveProfile curve(length_, limits.velocity, limits.accel, limits.jerk);
    const auto ends = curve.phase_ends();
    const double jerk = limits.jerk, accel = curve.peak_accel(), peak = curve.peak();
    const double rise = ends[0], even = ends[1] - ends[0], cruise = ends[3] - ends[2];
    const double part = jerk * rise * rise * rise / 6, gain = 0.5 * jerk * rise * rise, top = peak - gain;
    const ProfileSegment launch{ProfileSegmentKind::from_rest, 0, part, rise, 0, 0, 0, jerk};
    ProfileSegment landing = launch;
    landing.kind = ProfileSegmentKind::to_rest;
    landing.begin = length_ - part;
    double begin = part;
    const auto add = [&](double seconds, double length, double velocity, double now, double more) {
        if (!(seconds > 0)) return;
        pieces_.push_back(constant_jerk_segment(begin, length, seconds, velocity, now, more));
        begin += length;
    };
    pieces_.push_back(launch);
    add(even, 0.5 * even * (gain + top), gain, accel, 0);
    add(rise, peak * rise - part, top, accel, -jerk);
    add(cruise, peak * cruise, peak, 0, 0);
    add(rise, peak * rise - part, peak, 0, -jerk);
    add(even, 0.5 * even * (gain + top), top, -accel, 0);
    pieces_.push_back(landing);
}

/// Writes the profile from a motion in progress. Writes nothing if it is too fast, or would reverse behind its end.
void VelocityPlanner::write_travel(const LimitInterval& limits) {
    const double velocity = std::sqrt(start_.velocity2), accel = 0.5 * start_.velocity2_slope;
    if (velocity > limits.velocity * (1 + rounding) || std::fabs(accel) > limits.accel * (1 + rounding)) return;
    const KinematicState start{0, std::min(velocity, limits.velocity), std::clamp(accel, -limits.accel, limits.accel)};
    const auto found = time_optimal_profile(start, {length_, 0, 0}, {limits.velocity, limits.accel, limits.jerk});
    if (!found) return;
    const auto phases = found->phases();
    double begin = 0;
    for (std::size_t i = 0; i < phases.size(); ++i) {
        const double seconds = std::fabs(phases[i].seconds);
        const ProfileSample at = phases[i].at(phases[i].end - seconds), then = phases[i].at(phases[i].end);
        const bool lands = i + 1 == phases.size();
        const double turn = !lands && at.jerk != 0 ? -at.accel / at.jerk : -1;  // extremum of the velocity in the phase
        const double within = turn > 0 && turn < seconds ? at.velocity + 0.5 * at.accel * turn : at.velocity;
        if (std::min({at.velocity, within, lands ? at.velocity : then.velocity}) <= 0 ||
            std::max({at.velocity, within, then.velocity}) > limits.velocity * (1 + rounding) ||
            std::fabs(at.accel) > limits.accel * (1 + rounding)) {
            pieces_.clear();
            return;
        }
        const double on = seconds * (at.velocity + seconds * (0.5 * at.accel + seconds * at.jerk * (1.0 / 6)));
        const double length = lands ? at.velocity * seconds / 3 : on;
        pieces_.push_back(lands ? to_rest_segment(length_ - length, length, at.velocity * at.velocity)
                                : constant_jerk_segment(begin, length, seconds, at.velocity, at.accel, at.jerk));
        begin += length;
    }
}

void VelocityPlanner::write() {
    const std::size_t n = cells_.size();
    const auto slope = [&](std::size_t knot) { return (square_[knot + 1] - square_[knot]) / way_[knot]; };
    const double first = slope(0) * 0.75 * launch_.length, last = -slope(n) * 0.75 * landing_.length;
    if (!moving()) pieces_.push_back(from_rest_segment(0, launch_.length, first));
    double before = slope(0);
    for (std::size_t i = 0; i < n; ++i) {
        const double after = slope(i + 1);
        const Cell& cell = cells_[i];
        pieces_.push_back(approximate_parabolic_segment(cell.begin, cell.length,
                                                        square_[i + 1] - 0.5 * before * cell.length, before,
                                                        (after - before) / cell.length));
        before = after;
    }
    pieces_.push_back(to_rest_segment(length_ - landing_.length, landing_.length, last));
}

}  // namespace motionrack::control
