// The ramps of an axis, from its registers: rates, target speed, steps of the speed, final deceleration.
#pragma once

#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

/// Increment of va per tick of the present ramp: A, or D during a deceleration with its own rate.
inline std::int64_t ramp_rate(const Axis& axis, const Speed& law) {
    return rules::used_speed(law.ramp < 0 && axis.gen.own_deceleration ? axis.decel : axis.accel);
}

/// Ticks from one rate of an S-ramp to the next: K, or L during a deceleration with its own jerk.
inline std::int64_t jerk_ticks(const Axis& axis) {
    const bool own = axis.gen.ramp < 0 && axis.gen.own_deceleration;
    return rules::jerk_ticks_per_k * rules::used_jerk(own ? axis.decel_jerk : axis.jerk);
}

/// The speed that the present ramp leads to.
std::int64_t target_speed(const Axis& axis);
/// Executes a tick of the third step: the speed approaches its target.
void advance_speed(Axis& axis);
/// Ticks until the third step does more than accumulate (>= 1), far if never.
std::int64_t ticks_to_speed_event(const Axis& axis);
/// Executes `ticks` of the third step at constant speed; called before the start ticks are consumed.
void skip_speed(Axis& axis, std::int64_t ticks);
/// Lets a generator wait for a step: until then it neither accumulates nor changes its speed.
inline void wait_for_step(Generator& gen) {
    gen.walks = true;
    gen.next_tick = far;
}

/// Estimated pulses of a deceleration from the present speed.
std::int64_t final_pulses(const Axis& axis);
/// Basic pulses until a weighted final deceleration; `left`: those of the drive without AO.
std::int64_t pulses_to_weighted_final(const Axis& axis, std::int64_t left);
/// Pulses until the ramps take half of the pulses of the drive.
std::int64_t pulses_to_half(const Axis& axis);

}  // namespace motionrack::mcx314
