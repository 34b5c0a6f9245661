// Control commands: what is set between ticks, and the answers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

void Engine::load_program_file() {
    State fresh;
    fresh.tick = state_.tick, fresh.sampled = state_.sampled;
    fresh.input = state_.input;
    for (std::size_t e = 0; e < encoder_count; ++e) fresh.encoders[e].raw = state_.encoders[e].raw;
    fresh.mcbsp.word = state_.mcbsp.word, fresh.mcbsp.previous = state_.mcbsp.previous;
    fresh.mcbsp.memory[0] = state_.mcbsp.memory[0];
    fresh.mcbsp.to_zero = state_.mcbsp.to_zero;
    fresh.lists.begin = {0, settings_.list1, settings_.list1 + settings_.list2, settings_.list_memory};
    fresh.lists.input_end = settings_.list1;
    fresh.laser.on = state_.laser.on, fresh.laser.on_since = state_.laser.on_since,
    fresh.laser.on_time = state_.laser.on_time;
    state_ = fresh;
    std::fill_n(memory_.get(), settings_.list_memory, Command{});
    tables_ = {};
    fly_table_.reset();
    filled_ = state_.tick;
    switch_laser(state_.tick * half_us_per_tick, false, state_.tick);
}

Result<void> Engine::load_correction(std::shared_ptr<const Table> table, int number) {
    if (number < 1 || number > table_count)
        return fail(Trouble::refused,
                    fmt::format("load_correction_file: there is no table {}; 1 to {}. Nothing was changed", number,
                                table_count));
    tables_[static_cast<std::size_t>(number - 1)] = std::move(table);
    return {};
}

Result<void> Engine::select_cor_table(int head_a, int head_b) {
    for (const int number : {head_a, head_b})
        if (number < 0 || number > table_count)
            return fail(Trouble::refused,
                        fmt::format("select_cor_table: there is no table {}; 1 to {}, or 0. Nothing was changed",
                                    number, table_count));
    state_.heads[0].table = head_a;
    state_.heads[1].table = head_b;
    return {};
}

Result<void> Engine::set_delays(const Delays& d) {
    for (const std::int64_t v : {d.jump, d.mark, d.polygon, d.edge_level, d.least_jump})
        if (v < 0 || v > 4294967295)
            return fail(Trouble::refused,
                        fmt::format("a delay of {} times 10 us is outside 0 to 4294967295; nothing was changed", v));
    if (d.laser_on < -32768 || d.laser_on > 65535 || d.laser_off < 0 || d.laser_off > 65535)
        return fail(
            Trouble::refused,
            fmt::format("laser delays of {} and {} times 0.5 us are outside -32768 and 0 to 65535; nothing was changed",
                        d.laser_on, d.laser_off));
    if (!within(d.jump_limit, 0, 16777215))
        return fail(
            Trouble::refused,
            fmt::format("a length limit of {} bits is outside 0 to 16777215; nothing was changed", d.jump_limit));
    state_.delays = d;
    return {};
}

void Engine::set_jump_speed(double bits_ms) {
    if (std::isfinite(bits_ms)) state_.jump_speed = std::clamp(bits_ms, 1.6, 800000.0);
}
void Engine::set_mark_speed(double bits_ms) {
    if (std::isfinite(bits_ms)) state_.mark_speed = std::clamp(bits_ms, 1.6, 800000.0);
}

Result<void> Engine::set_hi(int head, Point gain, Point offset) {
    if (head < 1 || head > 3)
        return fail(Trouble::refused, fmt::format("set_hi: there is no scan head {}; 1, 2 or 3 (both)", head));
    if (!within(gain.x, -16, 16) || !within(gain.y, -16, 16) || !within(offset.x, field_least, field_greatest) ||
        !within(offset.y, field_least, field_greatest))
        return fail(Trouble::refused,
                    fmt::format("set_hi: gain ({}, {}) or offset ({}, {}) is out of range; nothing was changed", gain.x,
                                gain.y, offset.x, offset.y));
    for (std::size_t i = 0; i < head_count; ++i)
        if (head >> i & 1) state_.heads[i].gain = gain, state_.heads[i].offset = offset;
    return {};
}

Result<void> Engine::set_rot_center(Point centre) {
    if (!within(centre.x, -8388608, 8388607) || !within(centre.y, -8388608, 8388607))
        return fail(Trouble::refused,
                    fmt::format("set_rot_center: ({}, {}) is outside -8388608 to 8388607 bits; nothing was changed",
                                centre.x, centre.y));
    state_.rot_center = centre;
    return {};
}

Result<void> Engine::simulate_encoder(int which) {
    if (which < 0 || which > 3)
        return fail(
            Trouble::refused,
            fmt::format("simulate_encoder: {} is not 0 (off), 1 (X), 2 (Y) or 3 (both); nothing was changed", which));
    for (std::size_t e = 0; e < encoder_count; ++e) state_.encoders[e].simulated = which >> e & 1;
    not_due_until_ = 0;
    return {};
}

Result<void> Engine::set_ext_start_delay(std::int32_t delay, int encoder) {
    if (encoder < 0 || encoder >= encoder_count)
        return fail(Trouble::refused,
                    fmt::format("set_ext_start_delay: there is no encoder {}; 0 or 1. Nothing was changed", encoder));
    state_.starts.delay = delay;
    state_.starts.encoder = encoder;
    return {};
}

Result<void> Engine::set_encoder_speed(int encoder, double counts_ms, double smooth) {
    if (encoder < 0 || encoder > 3)
        return fail(Trouble::refused,
                    fmt::format("set_encoder_speed: there is no encoder {}; 0, 1, or 2, 3 for both", encoder));
    if (!std::isfinite(counts_ms) || !within(smooth, 0, 1))
        return fail(Trouble::refused,
                    fmt::format("set_encoder_speed: speed {}, smoothing {} (0 to 1)", counts_ms, smooth));
    State& s = state_;
    s.speed_watched = 1;
    s.speed_encoder = encoder;
    s.speed_target = std::clamp(counts_ms, 100.0, 16000.0);
    s.speed_smooth = smooth;
    for (Encoder& e : s.encoders) e.slow1 = e.slow2 = 0;
    return {};
}

double Engine::encoder_speed() const {
    const State& s = state_;
    if (!s.speed_watched) return 0;
    const double x = s.encoders[0].slow2, y = s.encoders[1].slow2;
    if (s.speed_encoder >= 2) return std::sqrt(x * x + y * y);
    return s.speed_encoder == 0 ? x : y;
}

void Engine::init_fly_2d(std::int32_t offset_x, std::int32_t offset_y) {
    for (std::size_t e = 0; e < encoder_count; ++e) state_.encoders[e].zero = state_.encoders[e].travel;
    state_.fly_2d_offset = {static_cast<double>(offset_x), static_cast<double>(offset_y)};
}

void Engine::external_stop() {
    const std::int64_t before = state_.startstop_info;
    stop_execution();
    state_.startstop_info = before | startstop_bit("EXTERNAL_STOP");
}

void Engine::encoder_sequence_error(int encoder) {
    raise(encoder == 0 ? marking_bit("ENCODER_X_SEQUENCE") : marking_bit("ENCODER_Y_SEQUENCE"), state_.tick);
}

std::uint32_t Engine::status() const {
    const Lists& l = state_.lists;
    return (l.running ? status_bit("BUSY") : 0) | (l.moving_alone ? status_bit("INTERNAL_BUSY") : 0) |
           (l.paused ? status_bit("PAUSED") : 0);
}

std::uint32_t Engine::list_status() const {
    const Lists& l = state_.lists;
    const std::uint32_t busy = l.running ? list_status_bit("BUSY1") << (l.current < l.begin[1] ? 0 : 1) : 0;
    return static_cast<std::uint32_t>(l.loaded) | busy;
}

std::array<std::int32_t, 2> Engine::read_encoder(int pos) const {
    const std::size_t at = pos == 0 ? 0 : 2;
    return {static_cast<std::int32_t>(state_.stored[at]), static_cast<std::int32_t>(state_.stored[at + 1])};
}

std::int64_t Engine::multi_power() const {
    const McBsp& m = state_.mcbsp;
    if (m.power_mode == 0) return m.typed[3];
    return m.power_factor * m.typed[3] / 16384;
}

std::uint32_t Engine::get_marking_info() {
    const auto out = static_cast<std::uint32_t>(state_.marking_info);
    state_.marking_info &= kept_when_read;
    return out;
}

std::uint32_t Engine::startstop_info() const {
    return static_cast<std::uint32_t>(state_.startstop_info) | startstop_bit("NO_STOP_SIGNAL") |
           (state_.laser.disabled ? 0 : startstop_bit("LASER_ENABLED"));
}

std::uint32_t Engine::get_startstop_info() {
    const std::uint32_t out = startstop_info();
    state_.startstop_info = 0;
    return out;
}

}  // namespace motionrack::rtc5
