// A ramp by the rules: ticks of the third step, and how long nothing happens in between.
#pragma once

#include <limits>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

/// A tick or a pulse that never comes.
inline constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max() / 4;

/// What va grows by in a tick of the present ramp: A, or D where it falls and has its own.
inline std::int64_t ramp_rate(const Axis& axis, const Speed& law) {
    return rules::used_speed(law.ramp < 0 && axis.gen.own_deceleration ? axis.decel : axis.accel);
}

/// Ticks from one rate of an S-ramp to the next: K, or where it falls and has its own L.
inline std::int64_t jerk_ticks(const Axis& axis) {
    const bool own = axis.gen.ramp < 0 && axis.gen.own_deceleration;
    return rules::jerk_ticks_per_k * rules::used_jerk(own ? axis.decel_jerk : axis.jerk);
}

/// Ticks until va reaches 64,000; small numbers, divided as such.
inline std::int64_t ticks_to_carry(std::int64_t speed_part, std::int64_t rate) {
    const auto left = static_cast<std::uint32_t>(rules::speed_carry - speed_part),
               each = static_cast<std::uint32_t>(rate);
    return (left + each - 1) / each;
}

/// In an S-ramp whose rate stays, ja goes round without effect.
inline bool keeps_rate(const Speed& law) {
    return law.phase == Phase::constant || (law.phase == Phase::decreasing && law.rate <= 1);
}

/// Ticks until an S-ramp changes its speed or its rate.
inline std::int64_t s_ticks(const Speed& law, std::int64_t jerk) {
    const std::int64_t step = law.rate > 0 ? ticks_to_carry(law.speed_part, law.rate) : far;
    if (keeps_rate(law)) return step;
    return std::max<std::int64_t>(1, std::min(jerk - law.rate_part, step));
}

/// `ticks` of an S-ramp in which neither changes.
inline void s_skip(Speed& law, std::int64_t ticks, std::int64_t jerk) {
    law.rate_part += ticks;
    if (law.rate_part >= jerk && ticks > 0) law.rate_part = (std::min(law.rate_part - ticks, jerk - 1) + ticks) % jerk;
    law.speed_part += ticks * law.rate;
}

/// One tick of an S-ramp; true if its aim is reached.
inline bool s_tick(Speed& law, std::int64_t jerk, std::int64_t top_rate) {
    if (++law.rate_part >= jerk) {
        law.rate_part = 0;
        if (law.phase == Phase::increasing) {
            if (++law.rate >= top_rate) law.phase = Phase::constant;
        } else if (law.phase == Phase::decreasing && law.rate > 1) {
            --law.rate;
        }
    }
    law.speed_part += law.rate;
    if (law.speed_part < rules::speed_carry) return false;
    law.speed_part -= rules::speed_carry;
    law.speed += law.ramp;
    if (law.phase == Phase::increasing) ++law.speed_steps;
    if (law.speed == law.aim) return true;
    if (law.phase != Phase::decreasing && rules::magnitude(law.aim - law.speed) <= law.speed_steps) {
        law.rate_part = jerk - law.rate_part;
        law.phase = Phase::decreasing;
    }
    return false;
}

}  // namespace motionrack::mcx314
