// The twin's third step: the speed approaches its target on a straight or an S-shaped ramp.
#include <cstdlib>
#include <motionrack/cards/mcx314/test/twin.hpp>

namespace motionrack::mcx314::twin {

namespace {
constexpr std::int64_t speed_carry = 64'000;
constexpr std::uint16_t flag_constant_end = 1u << 5;
constexpr std::uint16_t flag_constant_start = 1u << 6;
}  // namespace

// Executes the third step of the rules; returns true if the drive ended.
bool Twin::speed_step(int a) {
    Axis& axis = axes_[a];
    Generator& gen = axis.gen;
    const auto at_start_speed = [&] { return gen.speed <= used_start_speed(axis.reg); };
    if (gen.stopping && at_start_speed()) return end(a), true;
    if (gen.s_curve)
        s_curve(a);
    else
        t_curve(a);
    gen.final_seen = gen.final;
    if (gen.stopping && at_start_speed()) return end(a), true;
    return false;
}

// Returns V, or its replacement: HV in slow drives of a home search; a lower speed if a triangle is avoided.
std::int64_t Twin::drive_speed(const Axis& axis) const {
    std::int64_t v = axis.as.slow() ? used(axis.as.hv, 1, 8'000) : used_speed(axis.reg);
    if (!axis.as.slow() && axis.as.cap != 0 && axis.as.cap < v) v = axis.as.cap;
    if (options_.slow_drive == SlowDrive::at_sv && v < used_start_speed(axis.reg)) return used_start_speed(axis.reg);
    return v;
}

std::int64_t Twin::target(int a) const {
    const Axis& axis = axes_[a];
    if (!axis.gen.final) return drive_speed(axis);
    const std::int64_t start_speed = used_start_speed(axis.reg);
    return axis.gen.speed > start_speed ? start_speed : axis.gen.speed;
}

void Twin::set_ramp(int a, int ramp) {
    Axis& axis = axes_[a];
    Generator& gen = axis.gen;
    if (gen.ramp != 0 && ramp == 0 && !gen.final) {
        gen.constant = true;
        axis.flags |= axis.wr1 >> 8 & flag_constant_start;
    }
    if (gen.ramp == 0 && ramp != 0 && gen.constant) {
        gen.constant = false;
        axis.flags |= axis.wr1 >> 8 & flag_constant_end;
    }
    gen.ramp = ramp;
}

void Twin::t_curve(int a) {
    Axis& axis = axes_[a];
    Generator& gen = axis.gen;
    const std::int64_t to = target(a);
    const int want = to > gen.speed ? +1 : to < gen.speed ? -1 : 0;
    if (want != gen.ramp) {
        set_ramp(a, want);
        gen.speed_part = 0;
    }
    if (gen.ramp == 0) return;
    gen.rate = gen.ramp < 0 && gen.own_decel ? used_decel(axis.reg) : used_accel(axis.reg);
    gen.speed_part += gen.rate;
    if (gen.speed_part >= speed_carry) {
        gen.speed_part -= speed_carry;
        gen.speed += gen.ramp;
    }
    if (gen.speed == target(a)) {
        set_ramp(a, 0);
        gen.speed_part = 0;
    }
}

namespace {

// Returns J of RULES.md for the present ramp, ticks.
template <class Axis>
std::int64_t s_jerk(const Axis& axis, bool extended) {
    const bool own_jerk = extended && axis.gen.ramp < 0 && axis.gen.own_decel;
    return 16 * used_jerk(own_jerk ? axis.reg.decel_jerk : axis.reg.jerk);
}

// Executes a tick of an S-curve; returns true if the target is reached.
bool s_tick(Generator& gen, std::int64_t limit, std::int64_t jerk_ticks) {
    using Phase = Generator::Phase;
    // Remaining change of the speed, in parts of 1/64,000 of a step.
    const auto left = [&gen] { return std::abs(gen.aim - gen.speed) * speed_carry - gen.speed_part; };
    if (gen.phase == Phase::increasing) {
        ++gen.rate_part;
        if (gen.rate_part >= jerk_ticks) {
            gen.rate_part = 0;
            gen.lower_rates += gen.rate;
            ++gen.rate;
            if (gen.rate >= limit) gen.phase = Phase::constant;
        }
    } else if (gen.rate > 1 && left() <= jerk_ticks * gen.lower_rates) {
        gen.phase = Phase::decreasing;
        --gen.rate;
        gen.lower_rates -= gen.rate;
    }
    gen.speed_part += gen.rate;
    if (gen.speed_part >= speed_carry) {
        gen.speed_part -= speed_carry;
        gen.speed += gen.ramp;
    }
    if (gen.speed == gen.aim) return true;
    const std::int64_t behind_the_middle = jerk_ticks * gen.lower_rates + (gen.rate_part + 1) * gen.rate;
    if (gen.phase == Phase::increasing && left() <= behind_the_middle) {
        gen.phase = Phase::decreasing;
        gen.rate_part = 0;
    }
    return false;
}

}  // namespace

void Twin::s_curve(int a) {
    Generator& gen = axes_[a].gen;
    if (gen.final && !gen.final_seen) s_turn_final(a);
    const std::int64_t to = target(a);
    if (gen.ramp == 0 && gen.speed != to) {
        set_ramp(a, to > gen.speed ? +1 : -1);
        gen.aim = to;
        gen.phase = Generator::Phase::increasing;
        gen.rate = gen.speed_part = gen.lower_rates = 0;
        gen.rate_part = gen.ramp < 0 ? s_jerk(axes_[a], extended_) : 0;
    }
    if (gen.ramp != 0) s_advance(a);
}

// Begins the final deceleration in this tick: drops an accelerating ramp, or gives a decelerating one a new target.
void Twin::s_turn_final(int a) {
    Generator& gen = axes_[a].gen;
    const std::int64_t to = target(a);
    const auto over = [&] {
        set_ramp(a, 0);
        gen.speed_part = gen.rate_part = 0;
    };
    if (gen.ramp > 0) return over();
    if (gen.ramp == 0) return;
    gen.aim = to;
    if (gen.speed <= gen.aim) return over();
    if (gen.phase == Generator::Phase::decreasing) {
        gen.phase = Generator::Phase::increasing;
        gen.rate_part = 0;
    }
}

void Twin::s_advance(int a) {
    Axis& axis = axes_[a];
    Generator& gen = axis.gen;
    const std::int64_t limit = gen.ramp < 0 && gen.own_decel ? used_decel(axis.reg) : used_accel(axis.reg);
    if (!s_tick(gen, limit, s_jerk(axis, extended_))) return;
    set_ramp(a, 0);
    gen.speed_part = gen.rate_part = 0;
}

}  // namespace motionrack::mcx314::twin
