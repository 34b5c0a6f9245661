#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <motionrack/control/trajectory/trajectory_interpolator.hpp>

namespace motionrack::control {

namespace {

/// Share of the velocity step limit of an axis at each end of a move; below min_noise a step from rounding to pulses is
/// ignored.
constexpr double jump_share = 0.3, min_noise = 0.1;
/// Largest error in pulses along a move, from its constant acceleration, and across it.
constexpr double off_pulses = 0.4;
constexpr double min_move_s = 0.0002;
/// A move may be shorter by this share to end nearer to whole pulses; the search stops at a position that is near
/// enough.
constexpr double earliest = 0.35, near_enough = 0.05;
constexpr int tries = 16;
/// Share of the rounding to half a pulse that remains after a move is shortened to whole pulses.
constexpr double noise_left = 0.25;
/// Factor between tried lengths.
constexpr double shorter = 0.7;
constexpr double min_accel = 1e-6;
/// Moves shorter than this (mm, degrees) are skipped.
constexpr double min_move_length = 1e-6;

/// Returns the length along the path: of XYZ, or of the fastest rotary axis if only rotary axes move.
double size_of(const Point& delta) {
    const double linear = std::sqrt(delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2]);
    return linear > min_length_mm ? linear : std::max({std::fabs(delta[3]), std::fabs(delta[4]), std::fabs(delta[5])});
}

Point between(const Point& from, const Point& to) {
    Point delta;
    for (std::size_t i = 0; i < delta.size(); ++i) delta[i] = to[i] - from[i];
    return delta;
}

/// Returns the difference between the velocity of an axis and its velocity on the chord.
double turn_of(const TrajectoryPoint& state, const Point& delta, double length, std::size_t axis) {
    const double along = length > 0 ? size_of(state.velocity) / length * delta[axis] : 0;
    return std::fabs(state.velocity[axis] - along);
}

}  // namespace

TrajectoryInterpolator::TrajectoryInterpolator(const MachineLimits& limits, const Point& start,
                                               InterpolatorSettings settings)
    : limits_(limits),
      path_limits_(limits),
      settings_(settings),
      generator_(limits, start, settings.generator),
      position_(start),
      planned_position_(start) {}

Result<void> TrajectoryInterpolator::push(const Move& move, bool overridable) {
    MOTIONRACK_TRY(const Geometry path, checked_path(move, position_, path_limits_));
    if (path.shape == PathShape::nothing && move.kind != MoveKind::dwell) return {};
    const std::uint8_t axes = axes_of(path);
    if (has_to_rest(path, axes)) {
        generator_.flush();
        run_axes_ = 0;
    }
    generator_.push({move, overridable, axes});
    last_ = path;
    last_axes_ = axes;
    run_axes_ |= axes;
    if (path.shape != PathShape::nothing) position_ = move.end;
    return {};
}

std::uint8_t TrajectoryInterpolator::axes_of(const Geometry& path) const {
    const Point components = max_tangent_components(path);
    unsigned axes = 0;
    for (std::size_t i = 0; i < components.size(); ++i)
        if (components[i] * path.length * limits_[i].pulses_per_unit >= 0.5) axes |= 1u << i;
    return static_cast<std::uint8_t>(axes);
}

/// Returns true if the card must stop between two moves: also before a blend that involves more axes than it
/// interpolates.
bool TrajectoryInterpolator::has_to_rest(const Geometry& path, std::uint8_t axes) const {
    if (!settings_.drive || path.shape == PathShape::nothing || last_.shape == PathShape::nothing) return false;
    const bool alike = axes == last_axes_ && axes == run_axes_;
    return (!alike && uses_auxiliary_axis(static_cast<std::uint8_t>(run_axes_ | axes))) ||
           settings_.drive->max_junction_velocity(last_, path) <= 0;
}

/// Returns true if more axes move than the card interpolates together.
bool TrajectoryInterpolator::uses_auxiliary_axis(std::uint8_t axes) const {
    return settings_.drive && std::popcount(axes) > settings_.drive->max_interpolated_axes();
}

bool TrajectoryInterpolator::pull(PlannedMove& planned, bool early) {
    planned = {};
    const NextMotion next = generator_.next(early);
    if (next == NextMotion::nothing) return false;
    planned.start = planned_position_;
    if (next == NextMotion::dwell) {
        planned.number = generator_.move_of_rest();
        planned.move = generator_.move(planned.number).move;
        planned.move.end = planned_position_;
        planned.move.seconds = settings_.cut_dwells ? std::min(settings_.max_seconds, generator_.dwell_seconds())
                                                    : generator_.dwell_seconds();
        generator_.advance_dwell(planned.move.seconds);
        return true;
    }
    const TrajectoryPoint begin = generator_.at(0);
    const double seconds = last_seconds_ = seconds_of_next();
    const TrajectoryPoint end = generator_.at(seconds);
    const double length = size_of(between(planned_position_, end.position));
    if (length < min_move_length && size_of(end.velocity) > 0) {  // at a reversal
        generator_.advance(seconds);
        return pull(planned, early);
    }
    planned.number = generator_.move_of(begin);
    const TrajectoryMove& move = generator_.move(planned.number);
    planned.move = move.move;
    if (uses_auxiliary_axis(move.axes)) planned.axes = move.axes;
    if (planned.move.kind != MoveKind::rapid) planned.move.kind = MoveKind::feed;
    planned.move.end = end.position;
    const double velocity_in = size_of(begin.velocity), velocity_out = size_of(end.velocity);
    planned.length = length;
    planned.entry_velocity = velocity_in;
    planned.cruise_velocity = std::max(velocity_in, velocity_out);
    planned.exit_velocity = velocity_out;
    planned.accel = std::max(
        std::fabs(velocity_out * velocity_out - velocity_in * velocity_in) / (2 * std::max(length, min_length_mm)),
        min_accel);
    planned.constant_accel = true;
    planned.move.feed = planned.cruise_velocity;
    planned_position_ = end.position;
    generator_.advance(seconds);
    return true;
}

/// Returns the longest duration with small errors. The ends are rounded to whole pulses, so its velocities are wrong by
/// half a pulse per move; a shorter move would not be better.
double TrajectoryInterpolator::seconds_of_next() const {
    const TrajectoryPoint begin = generator_.at(0);
    const double min_duration = uses_auxiliary_axis(generator_.move(generator_.move_of(begin)).axes)
                                    ? settings_.drive->min_velocity_update_s()
                                    : min_move_s;
    double seconds = std::min({settings_.max_seconds, generator_.left(), std::max(4 * last_seconds_, min_duration)});
    for (; seconds >= 2 * min_move_s; seconds *= shorter) {
        const ApproximationError is = roughness_of(begin, seconds);
        if (is.velocity_step <= jump_share && (is.chord_error <= off_pulses || seconds < 2 * min_duration)) break;
        if (noise_left * is.quantisation > std::max(is.velocity_step, min_noise)) break;
    }
    // Avoids a tiny remainder before the end.
    const double left = generator_.left();
    if (left - seconds >= 0.5 * seconds) return snap_to_pulses(begin, seconds);
    return left < 2 * min_move_s || roughness_of(begin, left).velocity_step <= jump_share ? left : 0.5 * left;
}

/// Shortens the move so that it ends nearer to whole pulses.
double TrajectoryInterpolator::snap_to_pulses(const TrajectoryPoint& begin, double seconds) const {
    if (roughness_of(begin, seconds).quantisation <= min_noise) return seconds;
    double best = seconds, min_off = 1;
    for (int k = 0; k < tries && min_off > near_enough; ++k) {
        const double time = seconds * (1 - earliest * k / tries),
                     off = off_whole_pulses(begin.position, generator_.at(time).position);
        if (off >= min_off) continue;
        best = time;
        min_off = off;
    }
    return best;
}

/// Returns how far the end is from whole pulses, in pulses of the worst axis, 0 .. 0.5. The longest axis is exempt: the
/// velocity sets its pulse spacing. The others share its duration, so that half a pulse more is a velocity step.
double TrajectoryInterpolator::off_whole_pulses(const Point& begin, const Point& end) const {
    std::array<double, axis_count> delta = {};
    for (std::size_t i = 0; i < delta.size(); ++i)
        if (limits_[i].present) delta[i] = std::fabs(end[i] - begin[i]) * limits_[i].pulses_per_unit;
    const auto long_axis = static_cast<std::size_t>(std::max_element(delta.begin(), delta.end()) - delta.begin());
    double off = 0;
    for (std::size_t i = 0; i < delta.size(); ++i) {
        const double pulses = end[i] * limits_[i].pulses_per_unit;
        if (limits_[i].present && i != long_axis) off = std::max(off, std::fabs(pulses - std::round(pulses)));
    }
    return off;
}

/// Returns the errors of one move that replaces the next `seconds` of the trajectory. On a short distance corners may
/// lie on both sides of the middle.
TrajectoryInterpolator::ApproximationError TrajectoryInterpolator::roughness_of(const TrajectoryPoint& begin,
                                                                                double seconds) const {
    const TrajectoryPoint middle = generator_.at(0.5 * seconds), end = generator_.at(seconds);
    const Point delta = between(begin.position, end.position), gone = between(begin.position, middle.position);
    double square = 0, along = 0, even = 0;
    for (std::size_t i = 0; i < delta.size(); ++i) {
        square += delta[i] * delta[i];
        along += delta[i] * gone[i];
        even +=
            delta[i] * seconds * (0.375 * begin.velocity[i] + 0.125 * end.velocity[i]);  // with constant acceleration
    }
    ApproximationError out;
    const double length = size_of(delta);
    const double per_square = square > 0 ? 1 / square : 0;
    for (std::size_t i = 0; i < delta.size(); ++i) {
        if (!limits_[i].present) continue;
        const double pulses = limits_[i].pulses_per_unit, jump = limits_[i].max_velocity_step;
        out.chord_error = std::max(out.chord_error, std::fabs((along - even) * per_square * delta[i]) * pulses);
        out.velocity_step = std::max(
            {out.velocity_step, turn_of(begin, delta, length, i) / jump, turn_of(end, delta, length, i) / jump});
        if (delta[i] != 0) out.quantisation = std::max(out.quantisation, 0.5 / (pulses * seconds * jump));
    }
    out.chord_error = std::max(out.chord_error, beside(delta, per_square, gone));
    for (const double part : {0.25, 0.75})
        if (out.chord_error <= off_pulses)
            out.chord_error =
                std::max(out.chord_error,
                         beside(delta, per_square, between(begin.position, generator_.at(part * seconds).position)));
    return out;
}

/// Returns the largest distance of a motion from the chord, in pulses of an axis.
double TrajectoryInterpolator::beside(const Point& delta, double per_square, const Point& gone) const {
    double along = 0, max_distance = 0;
    for (std::size_t i = 0; i < delta.size(); ++i) along += delta[i] * gone[i];
    for (std::size_t i = 0; i < delta.size(); ++i)
        if (limits_[i].present)
            max_distance =
                std::max(max_distance, std::fabs(gone[i] - along * per_square * delta[i]) * limits_[i].pulses_per_unit);
    return max_distance;
}

}  // namespace motionrack::control
