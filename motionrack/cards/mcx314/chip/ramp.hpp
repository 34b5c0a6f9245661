// Functions for the ramps of an axis: rates, target speed, speed steps, final deceleration.
#pragma once

#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

/// Returns the increment of va per tick of the present ramp: A, or D during a deceleration with its own rate.
inline std::int64_t ramp_rate(const Axis& axis, const Speed& law) {
    return rules::used_speed(law.ramp < 0 && axis.gen.own_deceleration ? axis.decel : axis.accel);
}

/// Returns the ticks from one rate of an S-ramp to the next: by K, or by L during a deceleration with its own jerk.
inline std::int64_t jerk_ticks(const Axis& axis) {
    const bool own = axis.gen.ramp < 0 && axis.gen.own_deceleration;
    return rules::jerk_ticks_per_k * rules::used_jerk(own ? axis.decel_jerk : axis.jerk);
}

/// Returns the speed, V units, at which the present ramp ends.
std::int64_t target_speed(const Axis& axis);
/// Executes step 3 of one tick: the speed approaches its target.
void advance_speed(Axis& axis);
/// Returns the ticks (>= 1) until step 3 does more than accumulate, far if never.
std::int64_t ticks_to_speed_event(const Axis& axis);
/// Executes step 3 of `ticks` ticks in which the speed does not change; called before the start ticks are consumed.
void skip_speed(Axis& axis, std::int64_t ticks);
/// Makes a generator wait for a step request: until then it neither accumulates nor changes its speed.
inline void wait_for_step(Generator& gen) {
    gen.walks = true;
    gen.next_tick = far;
}

/// Returns the estimated pulses of a deceleration from the present speed.
std::int64_t final_pulses(const Axis& axis);
/// Returns the basic pulses (>= 1) until a final deceleration that uses D begins; `left`: remaining pulses of the drive
/// without AO.
std::int64_t pulses_to_weighted_final(const Axis& axis, std::int64_t left);
/// Returns the pulses until the acceleration and its deceleration together take half of the drive's pulses, far if it
/// does not accelerate.
std::int64_t pulses_to_half(const Axis& axis);

}  // namespace motionrack::mcx314
