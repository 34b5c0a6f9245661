// Ratios and thresholds of a transmission.
#include <cmath>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/parts/transmission.hpp>
#include <numeric>

namespace motionrack::parts {

namespace {

constexpr double nano = 1e9;
constexpr double exact_limit = 9007199254740992.0;          // 2^53: up to here a double holds every whole number
constexpr double farthest_microsteps = 4503599627370496.0;  // microsteps; beyond the reach of every axle

Ratio reduced(std::int64_t num, std::int64_t den) {
    const std::int64_t common = std::gcd(num, den);
    return {num / common, den / common};
}

std::int64_t in_nano(double value) {
    MOTIONRACK_ASSERT(value > 0 && value <= 1e6);
    const auto whole = static_cast<std::int64_t>(value * nano + 0.5);
    MOTIONRACK_ASSERT(whole > 0);
    return whole;
}

}  // namespace

Ratio linear_travel(double lead_mm) {
    return reduced(in_nano(lead_mm), static_cast<std::int64_t>(nano));
}

Ratio rotary_travel(double gear_ratio) {
    return reduced(360 * static_cast<std::int64_t>(nano), in_nano(gear_ratio));
}

Transmission::Transmission(const TransmissionSettings& settings, std::int64_t pulses_per_rev, TransmissionState& state)
    : settings_(settings), state_(state) {
    MOTIONRACK_ASSERT(settings.travel_per_rev.num > 0 && settings.travel_per_rev.den > 0 && pulses_per_rev > 0);
    MOTIONRACK_ASSERT(settings.backlash >= 0);
    const std::int64_t common = std::gcd(settings.travel_per_rev.num, pulses_per_rev);
    const std::int64_t num = settings.travel_per_rev.num / common, pulses = pulses_per_rev / common;
    num_ = static_cast<double>(num);
    den_ = static_cast<double>(settings.travel_per_rev.den) * static_cast<double>(pulses);
    MOTIONRACK_ASSERT(num_ < exact_limit && den_ < exact_limit);
    play_ = static_cast<std::int64_t>(settings.backlash * den_ / num_ + 0.5);
    if (settings.end_minus) travel_.below = last_at_or_below(*settings.end_minus) - 1;
    if (settings.end_plus) travel_.above = first_at_or_above(*settings.end_plus) + play_ + 1;
    MOTIONRACK_ASSERT(!travel_.left(0));  // the axis starts between its ends of travel
}

std::int64_t Transmission::first_at_or_above(double position) const {
    const double guess = std::floor((position - settings_.initial_position) / num_ * den_);
    auto table = static_cast<std::int64_t>(std::fmin(std::fmax(guess, -farthest_microsteps), farthest_microsteps));
    // The division may be off by a rounding; position_of decides.
    while (position_of(table) < position && table < static_cast<std::int64_t>(farthest_microsteps)) ++table;
    while (position_of(table - 1) >= position && table > -static_cast<std::int64_t>(farthest_microsteps)) --table;
    return table;
}

std::int64_t Transmission::last_at_or_below(double position) const {
    const std::int64_t table = first_at_or_above(position);
    return position_of(table) <= position ? table : table - 1;
}

}  // namespace motionrack::parts
