// Unobserved steps of a speed are combined: found ahead, and executed at once.
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

/// True if generator `a` is on a ramp whose steps are unobserved.
bool Chip::may_walk(int a) const {
    const Axis& axis = state_.axis[a];
    const Generator& gen = axis.gen;
    if (gen.ramp == 0 || (state_.moved_by(a) & (listeners_.heard | state_.following)) != 0) return false;
    if (gen.stopping && gen.speed <= rules::used_speed(axis.start_speed)) return false;
    if (gen.s_curve) return !gen.final || gen.final_seen;
    const std::int64_t to = target_speed(axis);
    return (to - gen.speed) * gen.ramp > 0;
}

/// Combines the step at next_tick with the following steps, if there are any before `phase_limit`.
void Chip::walk_ahead(int a, std::int64_t phase_limit) {
    Generator& gen = state_.axis[a].gen;
    if (!may_walk(a)) return;
    const Walk& ahead = state_.ahead[a] = law_.walk(a, far, phase_limit);
    gen.walks = ahead.ticks > 0;
    if (gen.walks) gen.next_tick = gen.at + ahead.ticks;
}

/// Advances generator `a` to tick `to` of its combined steps, at most to their end; or it waits.
void Chip::bring_along(int a, std::int64_t to) {
    Generator& gen = state_.axis[a].gen;
    const std::int64_t ticks = to - gen.at;
    if (state_.halted(a)) {
        gen.at = to;
        return;
    }
    const Walk done = to == gen.next_tick ? state_.ahead[a] : law_.walk(a, ticks, far);
    const std::int64_t rest = ticks - done.ticks, rest_phase = rest * done.law.speed;
    const std::int64_t pulses = law_.pulses_of(gen, done.phase + rest_phase);
    std::int64_t acc = gen.acc + done.phase + rest_phase;
    if (pulses > 0) {
        acc -= law_.phase_for(gen, pulses);
        PulseMoment moment{to, acc, done.law.speed};
        if (rest == 0) moment.speed = done.last_speed;
        if (acc >= (rest > 0 ? rest_phase : done.last_phase)) moment = law_.last_pulse(a, pulses, ticks);
        skip_pulses(a, pulses, moment);
    }
    gen.acc = acc;
    static_cast<Speed&>(gen) = done.law;
    state_.ahead[a].ticks -= ticks;
    state_.ahead[a].phase -= done.phase + rest_phase;
    gen.final_seen = gen.final;
    gen.at = to;
    skip_speed(state_.axis[a], rest);
}

}  // namespace motionrack::mcx314
