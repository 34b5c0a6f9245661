// Rates of an axis' ramps, from its registers.
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

}  // namespace motionrack::mcx314
