// The third step of a tick: the speed approaches its target on a straight or an S-shaped ramp (RULES.md).
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

/// Returns true if the drive ended.
bool Chip::speed_step(int a) {
    Axis& axis = state_.axis[a];
    Generator& gen = axis.gen;
    auto at_start_speed = [&] { return gen.speed <= rules::used_speed(axis.start_speed); };
    if (gen.stopping && at_start_speed()) return end(a), true;
    const std::int64_t before = gen.speed;
    if (gen.s_curve)
        s_curve(a);
    else
        t_curve(a);
    gen.final_seen = gen.final;
    if (gen.speed != before) law_changed_of(a);
    if (gen.stopping && at_start_speed()) return end(a), true;
    return false;
}

std::int64_t Chip::target(const Axis& axis) const {
    if (!axis.gen.final) return rules::used_speed(axis.speed);
    return std::min(axis.gen.speed, rules::used_speed(axis.start_speed));
}

void Chip::set_ramp(int a, int ramp) {
    Axis& axis = state_.axis[a];
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

void Chip::t_curve(int a) {
    Axis& axis = state_.axis[a];
    Generator& gen = axis.gen;
    const std::int64_t to = target(axis);
    const int want = to > gen.speed ? 1 : to < gen.speed ? -1 : 0;
    if (want != gen.ramp) {
        set_ramp(a, want);
        gen.speed_part = 0;
    }
    if (gen.ramp == 0) return;
    gen.rate = ramp_rate(axis, gen);
    gen.speed_part += gen.rate;
    if (gen.speed_part >= rules::speed_carry) {
        gen.speed_part -= rules::speed_carry;
        gen.speed += gen.ramp;
    }
    if (gen.speed == target(axis)) {
        set_ramp(a, 0);
        gen.speed_part = 0;
    }
}

void Chip::s_curve(int a) {
    Generator& gen = state_.axis[a].gen;
    if (gen.final && !gen.final_seen) s_turn_final(a);
    const std::int64_t to = target(state_.axis[a]);
    if (gen.ramp == 0 && gen.speed != to) {
        set_ramp(a, to > gen.speed ? 1 : -1);
        rules::s_begin(gen, to, jerk_ticks(state_.axis[a]));
    }
    if (gen.ramp != 0) s_advance(a);
}

/// The final deceleration begins in this tick: an accelerating ramp is dropped, a decelerating one gets a new target.
void Chip::s_turn_final(int a) {
    Generator& gen = state_.axis[a].gen;
    auto over = [&] {
        set_ramp(a, 0);
        gen.speed_part = gen.rate_part = 0;
    };
    if (gen.ramp > 0) return over();
    if (gen.ramp == 0) return;
    gen.aim = target(state_.axis[a]);
    if (gen.speed <= gen.aim) return over();
    if (gen.phase == RatePhase::decreasing) {
        gen.phase = RatePhase::increasing;
        gen.rate_part = 0;
    }
}

void Chip::s_advance(int a) {
    Axis& axis = state_.axis[a];
    Generator& gen = axis.gen;
    if (!rules::s_tick(gen, jerk_ticks(axis), ramp_rate(axis, gen))) return;
    set_ramp(a, 0);
    gen.speed_part = gen.rate_part = 0;
}

}  // namespace motionrack::mcx314
