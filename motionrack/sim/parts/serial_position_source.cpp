// Sampling and sending of position words.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <motionrack/base/trig.hpp>
#include <motionrack/sim/parts/serial_position_source.hpp>

namespace motionrack::parts {

Result<SerialPositionSource> SerialPositionSource::make(const Conveyor& track, const SerialPositionSettings& s) {
    const auto within = [](double v, double min, double max) { return v >= min && v <= max; };
    if (!within(std::abs(s.bits_per_mm), 1e-6, 1e9))
        return fail(
            ErrorKind::refused,
            fmt::format("the resolution is {} bits/mm; it must be 0.000001 to 1e9, or negative", s.bits_per_mm));
    if (!within(s.period_us, 1, 1e6) || !within(s.delay_us, 0, 1e6))
        return fail(
            ErrorKind::refused,
            fmt::format("the period is {} us and the delay {} us; they must be 1 to 1000000 us and 0 to 1000000 us",
                        s.period_us, s.delay_us));
    if (s.two_axes && track.settings().rotary)
        return fail(ErrorKind::refused,
                    "a rotary table has one angle, but the sender is set to two axes; use a belt, or one axis");
    SerialPositionSource out;
    out.track_ = &track;
    out.settings_ = s;
    const SinCos t = sin_cos(track.settings().direction_deg * (pi / 180));
    out.cosine_ = t.cos, out.sine_ = t.sin;
    return out;
}

std::uint32_t SerialPositionSource::word_at(double t_s) const {
    const double travel = track_->travel(t_s) * settings_.bits_per_mm;
    const auto whole = [](double v) {
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(v + 0.5)));
    };
    if (!settings_.two_axes) return whole(travel);
    return (whole(travel * cosine_) & 0xFFFF) | whole(travel * sine_) << 16;
}

void SerialPositionSource::words(std::int64_t first_tick, std::span<std::uint32_t> out) const {
    double read_before = std::numeric_limits<double>::quiet_NaN();
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double us = static_cast<double>(first_tick + static_cast<std::int64_t>(i)) * 10 - settings_.delay_us;
        const double reading = std::floor(us / settings_.period_us);
        if (reading != read_before) word = word_at(reading * settings_.period_us * 1e-6);
        read_before = reading;
        out[i] = word;
    }
}

}  // namespace motionrack::parts
