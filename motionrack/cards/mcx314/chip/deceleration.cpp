// Estimates, from the acceleration of a drive, the pulse at which its final deceleration begins.
#include <motionrack/cards/mcx314/chip/ramp.hpp>

namespace motionrack::mcx314 {

std::int64_t final_pulses(const Axis& axis) {
    if (!axis.gen.weighted) return axis.gen.accel_pulses;
    return rules::ceil_div(axis.gen.accel_pulses * rules::used_speed(axis.accel), rules::used_speed(axis.decel));
}

std::int64_t pulses_to_weighted_final(const Axis& axis, std::int64_t left) {
    const Generator& gen = axis.gen;
    if (gen.ramp < 0) return 1;
    if (gen.ramp == 0) return std::max<std::int64_t>(1, left - final_pulses(axis));
    // The first k with left - k <= ceil((accel_pulses + k) * a / d).
    const std::int64_t a = rules::used_speed(axis.accel), d = rules::used_speed(axis.decel);
    const std::int64_t missing = (left - 1) * d - gen.accel_pulses * a;
    return missing < 0 ? 1 : missing / (a + d) + 1;
}

std::int64_t pulses_to_half(const Axis& axis) {
    const Generator& gen = axis.gen;
    if (gen.final || gen.ramp <= 0) return far;
    // The first x = accel_pulses + k with 2 * (x + ceil(x * a / d)) >= P.
    const std::int64_t half = (std::int64_t{axis.pulses} + 1) / 2;
    const std::int64_t d = rules::used_speed(axis.decel), a = gen.weighted ? rules::used_speed(axis.accel) : d;
    const std::int64_t x = half <= 0 ? 0 : (half - 1) * d / (a + d) + 1;
    return std::max<std::int64_t>(1, x - gen.accel_pulses);
}

}  // namespace motionrack::mcx314
