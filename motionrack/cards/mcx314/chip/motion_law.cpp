// Positions, rates and pulses of the axes at an instant, and the pulses until the final deceleration.
#include <cmath>
#include <motionrack/cards/mcx314/chip/motion_law.hpp>
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

std::int64_t MotionLaw::count_at(int a, Instant t) const {
    const Axis& axis = state_.axis[a];
    const bool on_path = (state_.chain >> a & 1u) != 0;
    const int generator = on_path ? state_.master : a;
    const Generator& gen = state_.axis[generator].gen;
    const std::int64_t ticks = tick_of(t) - gen.at - gen.wait;
    if (gen.drive == Drive::idle || ticks <= 0) return axis.count;
    const std::int64_t pulses = pulses_of(gen, phase_in(generator, ticks));
    if (!on_path) return axis.count + pulses * axis.direction;
    const std::array<std::int64_t, 3> steps = path_steps(pulses);
    for (int i = 0; i < state_.path.command.count; ++i)
        if (state_.path.command.axis[i] == a) return axis.count + steps[i];
    return axis.count;
}

/// Returns the rate of axis `a` at `t`, pulses/s, signed; on an arc that along the tangent.
double MotionLaw::rate_of(int a, Instant t) const {
    const Axis& axis = state_.axis[a];
    const bool on_path = (state_.chain >> a & 1u) != 0;
    const int generator = on_path ? state_.master : a;
    const Generator& gen = state_.axis[generator].gen;
    if (gen.drive == Drive::idle || state_.halted(generator)) return 0;
    const std::int64_t ticks = std::max<std::int64_t>(0, tick_of(t) - gen.at - gen.wait);
    const double phase =
        rules::clock_hz * static_cast<double>(gen.walks ? walk(generator, ticks, far).law.speed : gen.speed);
    if (!on_path) return phase / static_cast<double>(gen.range_now) * axis.direction;
    const Path& path = state_.path;
    const double r1 = static_cast<double>(path.range_for[0]);
    const double extra = path.command.count == 2 ? static_cast<double>(path.range_for[1]) - r1 : 0.0;
    for (int i = 0; i < path.command.count; ++i) {
        if (path.command.axis[i] != a) continue;
        if (path.command.pattern()) return phase / r1 * pattern_share(i);
        const double sign = path_direction(i);
        if (path.command.arc()) {
            const int s = rules::octants[path.arc.octant].short_axis;
            const auto at = path.arc.after(pulses_of(gen, phase_in(generator, ticks)));
            const double slope = std::min(
                1.0, std::fabs(static_cast<double>(at[s])) / std::max(1.0, std::fabs(static_cast<double>(at[1 - s]))));
            const double basic = phase / (r1 + extra * slope);
            return sign * (s == i ? basic : basic * slope);
        }
        const double max_p = static_cast<double>(path.max_pulses);
        double slope = 0;
        if (extra != 0)
            slope = static_cast<double>(
                        std::min(rules::magnitude(path.command.finish[0]), rules::magnitude(path.command.finish[1]))) /
                    max_p;
        return phase / (r1 + extra * slope) * static_cast<double>(path.command.finish[i]) / max_p;
    }
    return 0;
}

/// Returns the last pulse of axis `a` as it is at tick `to`.
PulseMark MotionLaw::mark_at(int a, std::int64_t to) const {
    const Axis& axis = state_.axis[a];
    const bool on_path = (state_.chain >> a & 1u) != 0;
    const int generator = on_path ? state_.master : a;
    const Generator& gen = state_.axis[generator].gen;
    const std::int64_t ticks = to - gen.at - gen.wait;
    if (gen.drive == Drive::idle || ticks <= 0) return axis.mark;
    const std::int64_t pulses = pulses_of(gen, phase_in(generator, ticks));
    if (pulses == 0) return axis.mark;
    const PulseMoment last = last_pulse(generator, pulses, ticks);
    PulseMark mark{last.when(), static_cast<std::int32_t>(last.speed), static_cast<std::int32_t>(gen.range_now),
                   axis.direction, 0};
    if (!on_path) return mark;
    const auto after = path_steps(pulses), before = path_steps(pulses - 1);
    int stepped = 0;
    bool own = false;
    for (int i = 0; i < state_.path.command.count; ++i) {
        if (after[i] == before[i]) continue;
        ++stepped;
        if (state_.path.command.axis[i] == a) own = true;
    }
    if (!own) return state_.path.command.mask() >> a & 1u ? PulseMark{} : axis.mark;
    mark.range = static_cast<std::int32_t>(state_.path.range_for[static_cast<std::size_t>(stepped - 1)]);
    return mark;
}

/// Returns the share (-1 .. +1) of the running word's basic pulses that step AX(i+1).
double MotionLaw::pattern_share(int i) const {
    const Pattern& pattern = state_.pattern;
    int steps = 0, at = 0;
    for (; at < Pattern::length && !pattern.ends(state_.path.command.count, at); ++at) steps += pattern.step(i, at);
    return pattern.place < Pattern::length && at > 0 ? static_cast<double>(steps) / at : 0.0;
}

std::int64_t MotionLaw::pulses_to_final(int a) const {
    const Axis& axis = state_.axis[a];
    const Generator& gen = axis.gen;
    std::int64_t total = 0;
    if (gen.final || gen.drive == Drive::continuous) return far;
    if (gen.drive == Drive::path) {
        if (!state_.decel_enabled || state_.queued || (!state_.path.command.line() && !gen.manual)) return far;
        total = state_.path.max_pulses;
    } else {
        total = axis.pulses;
    }
    if (gen.manual) return std::max<std::int64_t>(1, std::int64_t{axis.decel_point} - gen.n);
    const std::int64_t left = total - gen.n - axis.offset;
    if (gen.weighted) return pulses_to_weighted_final(axis, left);
    // P - n <= accel_pulses + AO, where accel_pulses increases, stays or decreases with n.
    if (gen.ramp > 0)
        return std::max<std::int64_t>(1, rules::ceil_div(std::max<std::int64_t>(0, left - gen.accel_pulses), 2));
    if (gen.ramp == 0) return std::max<std::int64_t>(1, left - gen.accel_pulses);
    return left <= gen.accel_pulses ? 1 : std::max<std::int64_t>(1, left);
}

}  // namespace motionrack::mcx314
