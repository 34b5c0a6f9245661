// Computes in closed form the tick of the next event, and the advance to it in one step.
//
//   tick    |--------- plain ticks, pulses in closed form ---------|  event tick, executed by the rules
//           now                                        speed step, special pulse, input ..
#include <motionrack/cards/mcx314/chip/fast_forward.hpp>
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

// ---- the tick of the next event

/// Finds the next tick at which generator `a` does more than accumulate, and whether that is only a step of its speed.
void FastForward::find_next_tick(int a) {
    Generator& gen = state_.axis[a].gen;
    gen.plain = gen.walks = false;
    if (gen.wait > 0 || gen.full_tick) {
        gen.next_tick = state_.tick + gen.wait + 1;
        if (gen.special_known) return;
    }
    if (!gen.special_known) {
        const std::int64_t pulses = pulses_to_special(a);
        gen.next_special = pulses >= far ? far : gen.n + pulses;
        gen.special_known = true;
        if (gen.wait > 0 || gen.full_tick) return;
    }
    const std::int64_t ticks = ticks_to_speed_event(state_.axis[a]);
    gen.next_tick = state_.tick + ticks;
    if (gen.next_special >= far) {
        gen.plain = true;
        if (state_.halted(a)) return wait_for_step(gen);
        if (ticks >= far) gen.next_tick = far;
        if (some_unheard()) walk_ahead(a, far);
        return;
    }
    const std::int64_t phase = law_.phase_for(gen, gen.next_special - gen.n) - gen.acc;
    gen.plain = ticks < far && ticks * gen.speed < phase;
    if (!gen.plain)
        gen.next_tick = state_.tick + std::max<std::int64_t>(1, quick_div(phase + gen.speed - 1, gen.speed));
    else if (some_unheard())
        walk_ahead(a, phase);
}

/// Returns the number of basic pulses (>= 1) until one does more than step its axes, far if never.
std::int64_t FastForward::pulses_to_special(int a) const {
    const Axis& own = state_.axis[a];
    const Generator& gen = own.gen;
    if (state_.halted(a)) return far;
    if (law_.walks_pulses(a)) return 1;
    std::int64_t pulses = law_.pulses_to_final(a);
    if (gen.no_triangle) pulses = std::min(pulses, pulses_to_half(own));
    if (gen.drive == Drive::fixed) pulses = std::min(pulses, std::int64_t{own.pulses} - gen.n);
    if (gen.drive != Drive::path) {
        pulses = std::min(pulses, steps_to_threshold(a, own.direction));
        return std::max<std::int64_t>(1, pulses);
    }
    const PathCommand& command = state_.path.command;
    pulses = std::min(pulses, command.arc() ? state_.path.arc.pulses_to_event() : state_.path.max_pulses - gen.n);
    for (int i = 0; i < command.count; ++i) {
        const int direction = law_.path_direction(i);
        if (direction == 0) continue;
        const std::int64_t steps = steps_to_threshold(command.axis[i], direction);
        if (steps < far) pulses = std::min(pulses, law_.pulses_until_steps(a, i, steps));
    }
    return std::max<std::int64_t>(1, pulses);
}

/// Returns the number of steps (>= 1) of an axis in `direction` until it passes a limit, a comparison or a watched
/// count, far if never.
std::int64_t FastForward::steps_to_threshold(int a, int direction) const {
    const Axis& axis = state_.axis[a];
    if (axis.pulses_wanted || (wr1::PULSE.test(axis.wr1) && !rr3::PULSE.test(axis.flags))) return 1;
    std::int64_t steps = far;
    for (int i = 0; i < listeners_.of_axis[a].size(); ++i) {
        const sim::Range& watch = axis.watch[i];
        if (direction > 0 && watch.above != sim::unwatched_above) steps = std::min(steps, watch.above - axis.count);
        if (direction < 0 && watch.below != sim::unwatched_below) steps = std::min(steps, axis.count - watch.below);
    }
    if (compares(axis) && !wr2::CMPSL.test(axis.wr2))
        steps = std::min(steps, steps_to_comparison(axis, axis.lp, direction));
    return std::max<std::int64_t>(1, steps);
}

// ---- many plain ticks at once

/// Advances generator `a`, which has no event up to tick `to`, to that tick.
void FastForward::bring_up(int a, std::int64_t to) {
    Axis& axis = state_.axis[a];
    const std::int64_t ticks = to - axis.gen.at;
    if (ticks <= 0) return;
    if (axis.gen.walks) return bring_along(a, to);
    skip_speed(axis, ticks);
    skip_phase(a, ticks);
    axis.gen.at = to;
}

/// Executes step 2 of a tick, the pulses, for the next `ticks`. Only the last pulse may do more than step its axes.
void FastForward::skip_phase(int a, std::int64_t ticks) {
    Generator& gen = state_.axis[a].gen;
    const std::int64_t waited = std::min<std::int64_t>(gen.wait, ticks);
    gen.wait -= static_cast<std::int32_t>(waited);
    ticks -= waited;
    if (ticks <= 0) return;
    const std::int64_t pulses = law_.pulses_of(gen, ticks * gen.speed);
    if (pulses > 0 && edges_.wanted_of(a)) edges_.make(a, waited, pulses);
    gen.acc += ticks * gen.speed;
    if (pulses == 0) return;
    gen.acc -= law_.phase_for(gen, pulses);
    skip_pulses(a, pulses, {gen.at + waited + ticks, gen.acc, gen.speed});
}

/// Executes the next `pulses` basic pulses; `last`: moment of the last one.
void FastForward::skip_pulses(int a, std::int64_t pulses, const PulseMoment& last) {
    Generator& gen = state_.axis[a].gen;
    auto add = [this](int i, std::int64_t steps) {
        if (steps == 0) return;
        Axis& axis = state_.axis[i];
        axis.lp = stepped(axis, axis.lp, steps);
        axis.count += steps;
        axis.made += rules::magnitude(steps);
        if (axis.steps_compared()) comparators_.compare(i);
        request_interrupt(axis, rr3::PULSE.mask);
    };
    unsigned stepped = 1u << a;
    if (gen.drive == Drive::path) {
        const std::array<std::int64_t, 3> steps = law_.path_steps(pulses);
        const std::array<std::int64_t, 3> before = law_.path_steps(pulses - 1);
        stepped = 0;
        int count = 0;
        for (int i = 0; i < state_.path.command.count; ++i) {
            if (steps[i] != before[i]) ++count, stepped |= 1u << state_.path.command.axis[i];
            add(state_.path.command.axis[i], steps[i]);
            state_.path.made[i] += rules::magnitude(steps[i]);
        }
        state_.stepped = count;
        gen.range_now = state_.path.range_for[static_cast<std::size_t>(count - 1)];
        if (state_.path.command.arc()) state_.path.arc.at = state_.path.arc.after(pulses);
    } else {
        add(a, pulses * state_.axis[a].direction);
    }
    gen.n += pulses;
    if (gen.ramp > 0) gen.accel_pulses += pulses;
    if (gen.ramp < 0 && !gen.final) gen.accel_pulses = std::max<std::int64_t>(0, gen.accel_pulses - pulses);
    mark_pulse(a, stepped, last);
}

/// Updates the wires of the generator's axes after a basic pulse: `stepped` have a new pulse, the last pulse of the
/// others has ended.
void FastForward::mark_pulse(int a, unsigned stepped, const PulseMoment& at) {
    const Generator& gen = state_.axis[a].gen;
    for_each_axis(state_.moved_by(a), [&](int i) {
        Axis& axis = state_.axis[i];
        axis.mark = {at.when(), stepped >> i & 1 ? static_cast<std::int32_t>(at.speed) : 0,
                     static_cast<std::int32_t>(gen.range_now), axis.direction, 0};
    });
}

/// Requests full execution of the present tick `to` by all generators.
void FastForward::work_in_full(std::int64_t to) {
    for_each_axis(state_.working, [&](int a) {
        Generator& gen = state_.axis[a].gen;
        bring_up(a, to - 1);
        gen.full_tick = true;
        gen.plain = gen.walks = false;
        gen.next_tick = to;
    });
}

// ---- combined steps of the speed

/// Returns true if generator `a` is on a ramp whose speed steps have no observers, so they may be combined.
bool FastForward::may_walk(int a) const {
    const Axis& axis = state_.axis[a];
    const Generator& gen = axis.gen;
    if (gen.ramp == 0 || (state_.moved_by(a) & (listeners_.heard | state_.following)) != 0) return false;
    if (gen.stopping && gen.speed <= rules::used_speed(axis.start_speed)) return false;
    if (gen.s_curve) return !gen.final || gen.final_seen;
    const std::int64_t to = target_speed(axis);
    return (to - gen.speed) * gen.ramp > 0;
}

/// Combines the speed step at next_tick with the following ones; `phase_limit`: sum of the speed up to the next pulse
/// with a further effect.
void FastForward::walk_ahead(int a, std::int64_t phase_limit) {
    Generator& gen = state_.axis[a].gen;
    if (!may_walk(a)) return;
    const Walk& ahead = state_.ahead[a] = law_.walk(a, far, phase_limit);
    gen.walks = ahead.ticks > 0;
    if (gen.walks) gen.next_tick = gen.at + ahead.ticks;
}

/// Advances generator `a` to tick `to` within its combined speed steps, at most to their end. A generator that waits
/// for a step request changes only its time.
void FastForward::bring_along(int a, std::int64_t to) {
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
