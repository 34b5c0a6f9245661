// Pulses of an interpolation in closed form: directions, steps of the axes, and the phase between pulses.
#include <motionrack/cards/mcx314/chip/motion_law.hpp>

namespace motionrack::mcx314 {

bool MotionLaw::path_finished() const {
    if (state_.path.command.pattern()) return state_.pattern.place == Pattern::length;
    return state_.path.command.arc() ? state_.path.arc.finished
                                     : state_.axis[state_.master].gen.n >= state_.path.max_pulses;
}

/// Returns the direction of AX(i+1), -1 or +1; 0: it is stationary.
int MotionLaw::path_direction(int i) const {
    const PathCommand& command = state_.path.command;
    if (command.pattern()) return 0;
    if (command.line()) return command.finish[i] > 0 ? 1 : command.finish[i] < 0 ? -1 : 0;
    const int d = rules::direction_in_octant(state_.path.arc.octant, i);
    return i == 1 && state_.path.arc.clockwise ? -d : d;
}

/// Returns true for bit patterns, single steps and constant vector speed of three axes: they have no closed form here,
/// so their pulses are executed one by one.
bool MotionLaw::walks_pulses(int a) const {
    const Path& path = state_.path;
    if (state_.axis[a].gen.drive != Drive::path) return false;
    if (path.command.pattern() || path.command.steps != 0) return true;
    return path.command.count == 3 &&
           (path.range_for[1] != path.range_for[0] || path.range_for[2] != path.range_for[0]);
}

/// Returns the number of basic pulses of the path until AX(i+1) has made `steps` more steps, far if that is beyond the
/// next event.
std::int64_t MotionLaw::pulses_until_steps(int a, int i, std::int64_t steps) const {
    const Path& path = state_.path;
    if (!path.command.arc()) {
        const std::int64_t p = rules::magnitude(path.command.finish[i]);
        const std::int64_t wanted = rules::line_steps(state_.axis[a].gen.n, p, path.max_pulses) + steps;
        return wanted > p ? far : rules::line_pulse_of_step(wanted, p, path.max_pulses) - state_.axis[a].gen.n;
    }
    const rules::Octant& octant = rules::octants[path.arc.octant];
    if (octant.short_axis == i) return steps;
    auto moved = [&](std::int64_t pulses) { return rules::magnitude(path.arc.after(pulses)[i] - path.arc.at[i]); };
    std::int64_t low = 0, high = path.arc.pulses_to_event() - 1;
    if (high < 1 || moved(high) < steps) return far;
    while (low + 1 < high) {
        const std::int64_t middle = (low + high) / 2;
        (moved(middle) < steps ? low : high) = middle;
    }
    return high;
}

/// Returns how many of the next `pulses` basic pulses step both axes of a path of two axes.
std::int64_t MotionLaw::extra_steps(std::int64_t pulses) const {
    const Path& path = state_.path;
    if (pulses <= 0) return 0;
    if (path.command.arc()) {
        const auto l = static_cast<std::size_t>(1 - rules::octants[path.arc.octant].short_axis);
        return rules::magnitude(path.arc.after(pulses)[l] - path.arc.at[l]);
    }
    const std::int64_t n = state_.axis[state_.master].gen.n;
    const std::int64_t p = std::min(rules::magnitude(path.command.finish[0]), rules::magnitude(path.command.finish[1]));
    return rules::line_steps(n + pulses, p, path.max_pulses) - rules::line_steps(n, p, path.max_pulses);
}

/// Returns the sum that acc must reach, by adding the speed, until the next `pulses` basic pulses (>= 1) are output.
std::int64_t MotionLaw::phase_for(const Generator& gen, std::int64_t pulses) const {
    if (gen.drive != Drive::path) return pulses * gen.range_now;
    const auto& range = state_.path.range_for;
    std::int64_t phase = gen.range_now + (pulses - 1) * range[0];
    if (range[1] != range[0] && state_.path.command.count == 2)
        phase += (range[1] - range[0]) * extra_steps(pulses - 1);
    return phase;
}

/// Returns the number of basic pulses in the next plain working ticks, whose speeds add up to `added`.
std::int64_t MotionLaw::pulses_of(const Generator& gen, std::int64_t added) const {
    const std::int64_t phase = gen.acc + added;
    if (phase < gen.range_now) return 0;
    if (gen.drive != Drive::path) return quick_div(phase, gen.range_now);
    const auto& range = state_.path.range_for;
    if (range[1] == range[0] || state_.path.command.count != 2) return 1 + quick_div(phase - gen.range_now, range[0]);
    std::int64_t low = 1 + quick_div(phase - gen.range_now, std::max(range[0], range[1]));
    std::int64_t high = 2 + quick_div(phase - gen.range_now, std::min(range[0], range[1]));
    high = std::min(high, gen.next_special - gen.n + 1);  // as planned: beyond it, an arc has another octant
    low = std::max<std::int64_t>(1, std::min(low, high - 1));
    while (low + 1 < high) {
        const std::int64_t middle = low + (high - low) / 2;
        (phase_for(gen, middle) <= phase ? low : high) = middle;
    }
    return low;
}

/// Returns the signed steps of AX1 .. AX3 in the next `pulses` basic pulses.
std::array<std::int64_t, 3> MotionLaw::path_steps(std::int64_t pulses) const {
    const Path& path = state_.path;
    std::array<std::int64_t, 3> steps{};
    if (path.command.pattern()) {
        const int end = static_cast<int>(std::min<std::int64_t>(Pattern::length, state_.pattern.place + pulses));
        for (int at = state_.pattern.place; at < end && !state_.pattern.ends(path.command.count, at); ++at)
            for (int i = 0; i < path.command.count; ++i) steps[i] += state_.pattern.step(i, at);
        return steps;
    }
    if (path.command.arc()) {
        const auto to = path.arc.after(pulses);
        steps[0] = to[0] - path.arc.at[0];
        steps[1] = path.arc.clockwise ? path.arc.at[1] - to[1] : to[1] - path.arc.at[1];
        return steps;
    }
    const std::int64_t n = state_.axis[state_.master].gen.n;
    for (int i = 0; i < path.command.count; ++i) {
        const std::int64_t p = rules::magnitude(path.command.finish[i]);
        const std::int64_t made = rules::line_steps(n + pulses, p, path.max_pulses) - path.made[i];
        steps[i] = path.command.finish[i] < 0 ? -made : made;
    }
    return steps;
}

}  // namespace motionrack::mcx314
