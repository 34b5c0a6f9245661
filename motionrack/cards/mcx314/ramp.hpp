// Speed ramps of a generator (RULES.md), shared by the virtual chip, the function library and the planner:
//
//   rate CA     ___                 An S-ramp's rate rises by 1 every J ticks, up to A or D, and falls again as soon as
//             _/   \_               the remaining speed change equals that of the falling rate. So the fall of the
//           _/       \_             rate mirrors its rise, and 1 is left of it when the target is reached.
//   increasing constant decreasing
#pragma once

#include <limits>
#include <motionrack/cards/mcx314/arithmetic.hpp>

namespace motionrack::mcx314 {

/// A tick or a pulse that never occurs.
inline constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max() / 4;

/// Phase of an S-ramp's rate.
enum class RatePhase : std::uint8_t { increasing, constant, decreasing };

/// A speed and its ramp.
struct Speed {
    std::int64_t speed = 0, speed_part = 0;  ///< CV, va
    std::int64_t rate = 0, rate_part = 0;    ///< CA, ja
    std::int64_t aim = 0;                    ///< target of an S-ramp
    std::int32_t ramp = 0;
    RatePhase phase = RatePhase::increasing;
    std::array<std::uint8_t, 3> reserved{};
};

namespace rules {

/// Returns the ticks until va reaches 64,000; divides 32-bit numbers, which is faster.
inline std::int64_t ticks_to_carry(std::int64_t speed_part, std::int64_t rate) {
    const auto left = static_cast<std::uint32_t>(speed_carry - speed_part), each = static_cast<std::uint32_t>(rate);
    return (left + each - 1) / each;
}

/// Returns the speed change until the rate has fallen from `rate` to 1, each rate below `rate` lasting `jerk` ticks;
/// unit: 1/64,000 of a speed step.
constexpr std::int64_t s_fall(std::int64_t rate, std::int64_t jerk) {
    return jerk * rate * (rate - 1) / 2;
}

/// Returns the remaining speed change to the S-ramp's target; unit: 1/64,000 of a speed step.
constexpr std::int64_t s_left(const Speed& law) {
    return magnitude(law.aim - law.speed) * speed_carry - law.speed_part;
}

/// Returns the ticks until an S-ramp changes its rate, or stops increasing it; far if never.
constexpr std::int64_t s_ticks_of_rate(const Speed& law, std::int64_t jerk) {
    const std::int64_t spare = std::max<std::int64_t>(0, s_left(law) - s_fall(law.rate, jerk));
    if (law.phase != RatePhase::increasing) return law.rate > 1 ? 1 + ceil_div(spare, law.rate) : far;
    const std::int64_t rise = std::max<std::int64_t>(1, jerk - law.rate_part);
    if (law.rate == 0) return rise;
    const std::int64_t more = std::max<std::int64_t>(1, spare - law.rate * (law.rate_part + 1));
    return std::min(rise, ceil_div(more, 2 * law.rate));
}

/// Returns the ticks until an S-ramp changes its speed or its rate.
inline std::int64_t s_ticks(const Speed& law, std::int64_t jerk) {
    const std::int64_t step = law.rate > 0 ? ticks_to_carry(law.speed_part, law.rate) : far;
    return std::min(step, s_ticks_of_rate(law, jerk));
}

/// Begins an S-ramp in the direction law.ramp. A decelerating ramp begins with the first step of its rate, as an
/// accelerating one ends with the last: they mirror each other.
constexpr void s_begin(Speed& law, std::int64_t aim, std::int64_t jerk) {
    law.aim = aim;
    law.phase = RatePhase::increasing;
    law.rate = law.speed_part = 0;
    law.rate_part = law.ramp < 0 ? jerk : 0;
}

/// Executes `ticks` of an S-ramp in which neither its speed nor its rate changes.
constexpr void s_skip(Speed& law, std::int64_t ticks) {
    if (law.phase == RatePhase::increasing) law.rate_part += ticks;
    law.speed_part += ticks * law.rate;
}

/// Executes one tick of an S-ramp with rates up to `top_rate`; returns true if its target is reached.
constexpr bool s_tick(Speed& law, std::int64_t jerk, std::int64_t top_rate) {
    if (law.phase == RatePhase::increasing) {
        if (++law.rate_part >= jerk) {
            law.rate_part = 0;
            if (++law.rate >= top_rate) law.phase = RatePhase::constant;
        }
    } else if (law.rate > 1 && s_left(law) <= s_fall(law.rate, jerk)) {
        --law.rate;
        law.phase = RatePhase::decreasing;
    }
    law.speed_part += law.rate;
    if (law.speed_part >= speed_carry) {
        law.speed_part -= speed_carry;
        law.speed += law.ramp;
        if (law.speed == law.aim) return true;
    }
    // Half of the speed change is done: the remaining ticks of this rate belong to the second half.
    if (law.phase == RatePhase::increasing && s_left(law) <= s_fall(law.rate, jerk) + law.rate * (law.rate_part + 1)) {
        law.phase = RatePhase::decreasing;
        law.rate_part = 0;
    }
    return false;
}

/// Duration of a ramp in ticks, and the sum of CV over them (pulses = phase / R).
struct Ramp {
    std::int64_t ticks = 0;
    std::int64_t phase = 0;
};

/// Computes an S-ramp of the speed from `from` to `to` (1 .. 8,000) with rates up to `limit` (A or D) and the jerk
/// parameter K.
inline Ramp s_ramp(std::int64_t from, std::int64_t to, std::int64_t limit, std::int64_t k) {
    Ramp ramp;
    if (from == to) return ramp;
    const std::int64_t jerk = jerk_ticks_per_k * used_jerk(k);
    Speed law{from};
    law.ramp = from < to ? 1 : -1;
    s_begin(law, to, jerk);
    for (bool there = false; !there;) {
        const std::int64_t ticks = s_ticks(law, jerk);
        ramp.ticks += ticks;
        ramp.phase += ticks * law.speed;
        s_skip(law, ticks - 1);
        there = s_tick(law, jerk, limit);
    }
    return ramp;
}

}  // namespace rules
}  // namespace motionrack::mcx314
