// Many unobserved steps of a speed at once: a ramp is then one event.
//
//   speed            ┌──            The steps are added up, from tick `at` to the last step before
//              ┌─────┘              - the pulse with a further effect (`phase_limit`),
//        ┌─────┘  phase             - the step that reaches the ramp's target, or
//    ────┘                          - tick `at` + `tick_limit`.
//      at ├── ticks ──┤
#include <motionrack/cards/mcx314/chip/motion_law.hpp>
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

namespace {

constexpr int max_walk_steps = 512;  // limited, because a change in between costs a repetition of these steps

/// Computes a straight ramp: a speed step takes 64,000 / rate ticks, or one more because of the remainder.
Walk t_walk(const Speed& from, std::int64_t rate, std::int64_t to, std::int64_t tick_limit, std::int64_t phase_limit) {
    Walk walk{from};
    const std::int64_t steps = std::min<std::int64_t>(max_walk_steps, rules::magnitude(to - from.speed) - 1);
    const std::int64_t whole = rules::speed_carry / rate, rest = rules::speed_carry % rate;
    std::int64_t part = from.speed_part, speed = from.speed;
    std::int64_t each = rules::ticks_to_carry(part, rate);
    for (std::int64_t i = 0; i < steps; ++i) {
        const std::int64_t phase = walk.phase + each * speed;
        if (phase >= phase_limit || walk.ticks + each > tick_limit) break;
        walk.phase = phase;
        walk.ticks += each;
        walk.last_phase = each * speed;
        walk.last_speed = speed;
        part += each * rate - rules::speed_carry;
        speed += from.ramp;
        each = rest > part ? whole + 1 : whole;
    }
    if (walk.ticks > 0) walk.law.rate = rate;
    walk.law.speed = speed;
    walk.law.speed_part = part;
    return walk;
}

/// Computes an S-ramp up to the last speed step before the target speed (before SV for a stop); the acceleration
/// varies.
Walk s_walk(const Speed& from, const Axis& axis, std::int64_t tick_limit, std::int64_t phase_limit) {
    const std::int64_t jerk = jerk_ticks(axis), top_rate = ramp_rate(axis, from);
    const std::int64_t end = axis.gen.stopping ? rules::used_speed(axis.start_speed) : -1;
    Speed law = from;
    std::int64_t rate = 0, whole = 0, rest = 0, ticks = 0, sum = 0, last_phase = 0, last_speed = 0;
    std::int64_t same_rate = rules::s_ticks_of_rate(law, jerk);
    for (int i = 0; i < max_walk_steps; ++i) {
        const std::int64_t next = law.speed + law.ramp;
        if (next == law.aim || next <= end) break;
        if (law.rate != rate) {
            rate = law.rate;
            whole = rules::speed_carry / rate;
            rest = rules::speed_carry % rate;
        }
        std::int64_t each = far;
        if (rate > 0)
            each =
                law.speed_part < rate ? whole + (rest > law.speed_part) : rules::ticks_to_carry(law.speed_part, rate);
        each = std::min(each, same_rate);
        const std::int64_t phase = each * law.speed;
        if (each > tick_limit - ticks || sum + phase >= phase_limit) break;
        last_phase = phase;
        last_speed = law.speed;
        rules::s_skip(law, each - 1);
        rules::s_tick(law, jerk, top_rate);
        same_rate = same_rate > each ? same_rate - each : rules::s_ticks_of_rate(law, jerk);
        sum += phase;
        ticks += each;
    }
    return {law, ticks, sum, last_phase, last_speed};
}

}  // namespace

/// Adds up the speed steps of generator `a` from its present state, within the given ticks and sum of the speed.
Walk MotionLaw::walk(int a, std::int64_t tick_limit, std::int64_t phase_limit) const {
    const Axis& axis = state_.axis[a];
    const Generator& gen = axis.gen;
    return gen.s_curve ? s_walk(gen, axis, tick_limit, phase_limit)
                       : t_walk(gen, ramp_rate(axis, gen), target_speed(axis), tick_limit, phase_limit);
}

/// Returns the sum of the generator's speed in the next `ticks`, none of them after next_tick.
std::int64_t MotionLaw::phase_in(int a, std::int64_t ticks) const {
    const Generator& gen = state_.axis[a].gen;
    if (state_.halted(a)) return 0;
    if (!gen.walks) return ticks * gen.speed;
    const Walk so_far = walk(a, ticks, far);
    return so_far.phase + (ticks - so_far.ticks) * so_far.law.speed;
}

/// Returns the tick and the speed of the last of `pulses` basic pulses within the next `ticks`.
PulseMoment MotionLaw::last_pulse(int a, std::int64_t pulses, std::int64_t ticks) const {
    const Generator& gen = state_.axis[a].gen;
    const std::int64_t phase = phase_for(gen, pulses) - gen.acc;
    Walk until{static_cast<const Speed&>(gen)};
    if (gen.walks) until = walk(a, ticks, phase);
    const std::int64_t left = phase - until.phase;
    const std::int64_t speed = until.law.speed, more = rules::ceil_div(left, speed);
    return {gen.at + until.ticks + more, more * speed - left, speed};
}

}  // namespace motionrack::mcx314
