// Step 3 of a tick: the speed approaches its target on a straight or an S-shaped ramp (RULES.md).
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

namespace {

void set_ramp(Axis& axis, int ramp) {
    Generator& gen = axis.gen;
    if (gen.ramp != 0 && ramp == 0 && !gen.final) {
        gen.constant = true;
        request_interrupt(axis, rr3::CSTA.mask);
    }
    if (gen.ramp == 0 && ramp != 0 && gen.constant) {
        gen.constant = false;
        request_interrupt(axis, rr3::CEND.mask);
    }
    if (gen.ramp != ramp) gen.special_known = false;
    gen.ramp = ramp;
}

void t_curve(Axis& axis) {
    Generator& gen = axis.gen;
    const std::int64_t to = target_speed(axis);
    const int want = to > gen.speed ? 1 : to < gen.speed ? -1 : 0;
    if (want != gen.ramp) {
        set_ramp(axis, want);
        gen.speed_part = 0;
    }
    if (gen.ramp == 0) return;
    gen.rate = ramp_rate(axis, gen);
    gen.speed_part += gen.rate;
    if (gen.speed_part >= rules::speed_carry) {
        gen.speed_part -= rules::speed_carry;
        gen.speed += gen.ramp;
    }
    if (gen.speed == target_speed(axis)) {
        set_ramp(axis, 0);
        gen.speed_part = 0;
    }
}

/// Adapts the S-ramp to the final deceleration, which begins in this tick: ends an accelerating ramp, gives a
/// decelerating one its new target.
void s_turn_final(Axis& axis) {
    Generator& gen = axis.gen;
    auto over = [&] {
        set_ramp(axis, 0);
        gen.speed_part = gen.rate_part = 0;
    };
    if (gen.ramp > 0) return over();
    if (gen.ramp == 0) return;
    gen.aim = target_speed(axis);
    if (gen.speed <= gen.aim) return over();
    if (gen.phase == RatePhase::decreasing) {
        gen.phase = RatePhase::increasing;
        gen.rate_part = 0;
    }
}

void s_advance(Axis& axis) {
    Generator& gen = axis.gen;
    if (!rules::s_tick(gen, jerk_ticks(axis), ramp_rate(axis, gen))) return;
    set_ramp(axis, 0);
    gen.speed_part = gen.rate_part = 0;
}

void s_curve(Axis& axis) {
    Generator& gen = axis.gen;
    if (gen.final && !gen.final_seen) s_turn_final(axis);
    const std::int64_t to = target_speed(axis);
    if (gen.ramp == 0 && gen.speed != to) {
        set_ramp(axis, to > gen.speed ? 1 : -1);
        rules::s_begin(gen, to, jerk_ticks(axis));
    }
    if (gen.ramp != 0) s_advance(axis);
}

}  // namespace

std::int64_t target_speed(const Axis& axis) {
    if (!axis.gen.final) return rules::used_speed(axis.speed);
    return std::min(axis.gen.speed, rules::used_speed(axis.start_speed));
}

void advance_speed(Axis& axis) {
    if (axis.gen.s_curve)
        s_curve(axis);
    else
        t_curve(axis);
}

std::int64_t ticks_to_speed_event(const Axis& axis) {
    const Generator& gen = axis.gen;
    if (gen.stopping && gen.speed <= rules::used_speed(axis.start_speed)) return 1;
    const std::int64_t to = target_speed(axis);
    if (!gen.s_curve) {
        const int want = to > gen.speed ? 1 : to < gen.speed ? -1 : 0;
        if (want != gen.ramp) return 1;
        if (gen.ramp == 0) return far;
        return rules::ticks_to_carry(gen.speed_part, ramp_rate(axis, gen));
    }
    if (gen.final && !gen.final_seen) return 1;
    if (gen.ramp == 0) return gen.speed != to ? 1 : far;
    return rules::s_ticks(gen, jerk_ticks(axis));
}

void skip_speed(Axis& axis, std::int64_t ticks) {
    Generator& gen = axis.gen;
    if (gen.ramp == 0) return;
    ticks -= std::min<std::int64_t>(gen.wait, ticks);
    if (gen.s_curve) return rules::s_skip(gen, ticks);
    if (ticks > 0) gen.rate = ramp_rate(axis, gen);
    gen.speed_part += ticks * gen.rate;
}

}  // namespace motionrack::mcx314
