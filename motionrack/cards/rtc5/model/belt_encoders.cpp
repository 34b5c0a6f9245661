// Counts the conveyor's encoders and filters their speed.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/cards/rtc5/model/belt_encoders.hpp>

namespace motionrack::rtc5 {

double BeltEncoders::effective(std::size_t encoder) const {
    const BeltCounter& e = state_.counters[encoder];
    return e.count() +
           static_cast<double>(wrapped(e.count() - e.previous)) * static_cast<double>(state_.tracking_error[encoder]);
}

void BeltEncoders::sample() {
    for (int number = 0; number < encoder_count; ++number) {
        BeltCounter& e = state_.counters[static_cast<std::size_t>(number)];
        e.previous = e.count();
        std::int32_t raw = wrapped(state_.input[static_cast<std::size_t>(number)]);
        if (connections_.inputs != nullptr) connections_.inputs->counts(number, tick_, {&raw, 1});
        e.travel += e.simulated ? simulated_counts : wrapped(raw - e.raw);
        e.raw = raw;
    }
    if (state_.speed_watched) {
        for (std::size_t e = 0; e < encoder_count; ++e) buffers_.counts[e][0] = state_.counters[e].count();
        filter_speed(0, 1);
    }
}

/// Updates the filtered speeds with ticks first .. n-1, whose counts are in the buffer.
void BeltEncoders::filter_speed(std::size_t first, std::size_t n) {
    const double through = 1 - state_.speed_smooth;
    for (std::size_t number = 0; number < encoder_count; ++number) {
        BeltCounter& e = state_.counters[number];
        const auto& counts = buffers_.counts[number];
        for (std::size_t i = first; i < n; ++i) {
            const std::int64_t before = i == 0 ? e.previous : counts[i - 1];
            const double speed = 100.0 * wrapped(counts[i] - before);
            e.slow1 += (speed - e.slow1) * through;
            e.slow2 += (e.slow1 - e.slow2) * through;
        }
    }
}

void BeltEncoders::load_counts(std::size_t encoder, std::size_t n) {
    const BeltCounter& e = state_.counters[encoder];
    std::int32_t* const out = buffers_.counts[encoder].data();
    const auto begin = static_cast<std::uint32_t>(e.count());
    if (e.simulated) {
        for (std::size_t i = 0; i < n; ++i)
            out[i] = static_cast<std::int32_t>(begin + static_cast<std::uint32_t>(simulated_counts) *
                                                           static_cast<std::uint32_t>(i));
    } else if (connections_.inputs != nullptr && n > 1) {
        std::int32_t* const raw = buffers_.raw[encoder].data();
        connections_.inputs->counts(static_cast<int>(encoder), tick_, {raw, n});
        for (std::size_t i = 0; i < n; ++i)
            out[i] = static_cast<std::int32_t>(
                begin + (static_cast<std::uint32_t>(raw[i]) - static_cast<std::uint32_t>(raw[0])));
    } else {
        std::fill_n(out, n, static_cast<std::int32_t>(begin));
    }
}

void BeltEncoders::load_effective(std::size_t encoder, std::size_t n) {
    load_counts(encoder, n);
    const std::int32_t* const counts = buffers_.counts[encoder].data();
    double* const out = buffers_.effective[encoder].data();
    const double ahead = static_cast<double>(state_.tracking_error[encoder]);
    if (ahead == 0) {
        for (std::size_t i = 0; i < n; ++i) out[i] = counts[i];
        return;
    }
    out[0] = effective(encoder);
    for (std::size_t i = 1; i < n; ++i)
        out[i] = counts[i] + static_cast<double>(static_cast<std::int32_t>(static_cast<std::uint32_t>(counts[i]) -
                                                                           static_cast<std::uint32_t>(counts[i - 1]))) *
                                 ahead;
}

void BeltEncoders::advance(std::int64_t n) {
    if (n == 1) return;
    if (state_.speed_watched) {
        for (std::size_t e = 0; e < encoder_count; ++e) load_counts(e, static_cast<std::size_t>(n));
        filter_speed(1, static_cast<std::size_t>(n));
    }
    for (int number = 0; number < encoder_count; ++number) {
        BeltCounter& e = state_.counters[static_cast<std::size_t>(number)];
        std::int32_t raw[2] = {wrapped(e.raw), wrapped(e.raw)};
        if (connections_.inputs != nullptr) connections_.inputs->counts(number, tick_ + n - 2, raw);
        e.travel += e.simulated ? simulated_counts * (n - 2) : wrapped(raw[0] - e.raw);
        e.previous = e.count();
        e.travel += e.simulated ? simulated_counts : wrapped(std::int64_t{raw[1]} - raw[0]);
        e.raw = raw[1];
    }
}

void BeltEncoders::take_start() {
    for (BeltCounter& e : state_.counters) {
        if (e.reset_at_start) e.zero = e.travel;
        e.reset_at_start = 0;
    }
}

void BeltEncoders::store(std::size_t pos) {
    for (std::size_t e = 0; e < encoder_count; ++e) state_.stored[pos * 2 + e] = count(e);
}

std::array<std::int32_t, 2> BeltEncoders::stored(int pos) const {
    const std::size_t at = pos == 0 ? 0 : 2;
    return {static_cast<std::int32_t>(state_.stored[at]), static_cast<std::int32_t>(state_.stored[at + 1])};
}

Result<void> BeltEncoders::simulate(int which) {
    if (which < 0 || which > 3)
        return fail(
            ErrorKind::refused,
            fmt::format("simulate_encoder: {} is not 0 (off), 1 (X), 2 (Y) or 3 (both); nothing was changed", which));
    for (std::size_t e = 0; e < encoder_count; ++e) state_.counters[e].simulated = which >> e & 1;
    return {};
}

Result<void> BeltEncoders::watch_speed(int encoder, double counts_ms, double smooth) {
    MOTIONRACK_CHECK(check_parameter("set_encoder_speed", "EncoderNo", encoder, 0, 3));
    if (!std::isfinite(counts_ms))
        return fail(
            ErrorKind::refused,
            fmt::format("set_encoder_speed: Speed is {}, which is not a number; nothing was changed", counts_ms));
    MOTIONRACK_CHECK(check_parameter("set_encoder_speed", "Smooth", smooth, 0, 1));
    EncodersState& s = state_;
    s.speed_watched = 1;
    s.speed_encoder = encoder;
    s.speed_target = std::clamp(counts_ms, 100.0, 16000.0);
    s.speed_smooth = smooth;
    for (BeltCounter& e : s.counters) e.slow1 = e.slow2 = 0;
    return {};
}

double BeltEncoders::speed() const {
    const EncodersState& s = state_;
    if (!s.speed_watched) return 0;
    const double x = s.counters[0].slow2, y = s.counters[1].slow2;
    if (s.speed_encoder >= 2) return std::sqrt(x * x + y * y);
    return s.speed_encoder == 0 ? x : y;
}

}  // namespace motionrack::rtc5
