// Control commands: what is set between ticks, and the answers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

namespace {

bool finite(std::initializer_list<double> values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}
bool within(double v, double least, double greatest) {
    return v >= least && v <= greatest;  // false for NaN
}

/// Scale * Angle * Matrix, and whether it does nothing.
void multiply(Transform& t) {
    const SinCos turn = sin_cos(t.angle_deg * (pi / 180));
    const double c = t.scale * turn.cos, s = t.scale * turn.sin;
    const auto& m = t.matrix;
    t.product = {c * m[0] - s * m[2], c * m[1] - s * m[3], s * m[0] + c * m[2], s * m[1] + c * m[3]};
    t.neutral = t.product == std::array<double, 4>{1, 0, 0, 1} && t.offset.x == 0 && t.offset.y == 0;
}

}  // namespace

/// Changes the transforms of `head` (1 A, 2 B, 3 both, 4 global), now or with the next jump.
template <class Change>
Result<void> Engine::change_transform(int head, int at_once, const Change& change) {
    if (head < 1 || head > 4)
        return fail(Trouble::refused,
                    fmt::format("there is no scan head {}; 1, 2, 3 (both) or 4 (before the correction)", head));
    if (at_once < 0 || at_once > 3) return fail(Trouble::refused, fmt::format("at_once is {}; 0 to 3", at_once));
    Transform* const now[3] = {&state_.heads[0].transform, &state_.heads[1].transform, &state_.global};
    for (std::size_t i = 0; i < 3; ++i) {
        const bool meant = i == 2 ? head == 4 : head != 4 && (head >> i & 1);
        if (!meant) continue;
        const std::int64_t bit = std::int64_t{1} << i;
        Transform changed = state_.later_count & bit ? state_.later[i] : *now[i];
        change(changed);
        multiply(changed);
        if (at_once == 2) {
            state_.later[i] = changed;
            state_.later_count |= bit;
        } else {
            *now[i] = changed;
            state_.later_count &= ~bit;
        }
    }
    return {};
}

void Engine::transforms_of_jump() {
    if (state_.later_count == 0) return;
    if (state_.later_count & 1) state_.heads[0].transform = state_.later[0];
    if (state_.later_count & 2) state_.heads[1].transform = state_.later[1];
    if (state_.later_count & 4) state_.global = state_.later[2];
    state_.later_count = 0;
}

Result<void> Engine::set_matrix(int head, std::array<double, 4> matrix, int at_once) {
    for (const double m : matrix)
        if (!within(m, -50, 50))
            return fail(Trouble::refused,
                        fmt::format("set_matrix: a coefficient is {}, outside -50 to 50; nothing was changed", m));
    return change_transform(head, at_once, [&](Transform& t) { t.matrix = matrix; });
}

Result<void> Engine::set_offset(int head, Point offset, int at_once) {
    if (!within(offset.x, -8388608, 8388607) || !within(offset.y, -8388608, 8388607))
        return fail(Trouble::refused,
                    fmt::format("set_offset: ({}, {}) is outside -8388608 to 8388607 bits; nothing was changed",
                                offset.x, offset.y));
    return change_transform(head, at_once, [&](Transform& t) { t.offset = offset; });
}

Result<void> Engine::set_angle(int head, double degrees, int at_once) {
    if (!within(degrees, -3600, 3600))
        return fail(Trouble::refused,
                    fmt::format("set_angle: {} is outside -3600 to 3600 degrees; nothing was changed", degrees));
    return change_transform(head, at_once, [&](Transform& t) { t.angle_deg = degrees; });
}

Result<void> Engine::set_scale(int head, double scale, int at_once) {
    if (!within(scale, -16, 16))
        return fail(Trouble::refused, fmt::format("set_scale: {} is outside -16 to 16; nothing was changed", scale));
    return change_transform(head, at_once, [&](Transform& t) { t.scale = scale; });
}

void Engine::transform_command(const Command& c) {
    const int at_once = static_cast<int>(c.op == Op::set_matrix_list   ? c.p[3]
                                         : c.op == Op::set_offset_list ? c.p[2]
                                                                       : c.p[1]) &
                        3;
    const auto change = [&](Transform& t) {
        if (c.op == Op::set_matrix_list) t.matrix[static_cast<std::size_t>(c.p[0] * 2 + c.p[1])] = c.p[2];
        if (c.op == Op::set_offset_list) t.offset = {c.p[0], c.p[1]};
        if (c.op == Op::set_angle_list) t.angle_deg = c.p[0];
        if (c.op == Op::set_scale_list) t.scale = c.p[0];
    };
    static_cast<void>(change_transform(c.head, at_once, change));
}

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
    if (!finite({counts_ms}) || !within(smooth, 0, 1))
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

Result<void> Engine::set_mcbsp_in(int mode, double scale) {
    MOTIONRACK_CHECK(list_command(Op::set_mcbsp_in_list, {static_cast<double>(mode), scale}));
    mcbsp_in(mode, scale);
    return {};
}

Result<void> Engine::set_multi_mcbsp_in(int port, std::int64_t factor, int mode) {
    MOTIONRACK_CHECK(list_command(Op::set_multi_mcbsp_in_list,
                                  {static_cast<double>(port), static_cast<double>(factor), static_cast<double>(mode)}));
    McBsp& m = state_.mcbsp;
    m.power_port = port, m.power_factor = factor, m.power_mode = mode;
    end_online();
    m.multi = 1;
    m.in_mode = 0;
    m.round = 0;
    m.typed = {};
    m.memory = {};
    state_.fly = Fly{FlyKind::multi, 1, 1};
    state_.fly.scale_x = state_.fly.scale_y = 1;
    return {};
}

Result<void> Engine::set_mcbsp_online(double scale_x, double scale_y, double resolution) {
    if (!finite({scale_x, scale_y, resolution}))
        return fail(Trouble::refused, "set_mcbsp_x, _y, _rot: a scale is no number; nothing was changed");
    McBsp& m = state_.mcbsp;
    m.online_x = scale_x != 0, m.online_y = scale_y != 0, m.online_rot = std::abs(resolution) >= least_resolution;
    m.online_scale_x = scale_x, m.online_scale_y = scale_y, m.online_resolution = resolution;
    const bool online = m.online_x || m.online_y || m.online_rot;
    const FlyKind kind = state_.fly.kind;
    m.online_matrix = 0;
    if (!online) return {};
    m.in_mode = m.multi = 0;
    if (kind == FlyKind::mcbsp || kind == FlyKind::mcbsp_rot || kind == FlyKind::multi) state_.fly = {};
    return {};
}

void Engine::set_mcbsp_matrix() {
    static_cast<void>(set_mcbsp_online(1, 0, 0));
    state_.mcbsp.online_matrix = 1;
}

Result<void> Engine::apply_mcbsp(int head, int at_once) {
    const McBsp& m = state_.mcbsp;
    if (m.online_matrix) {
        const std::int32_t coefficient = m.memory[1];
        return change_transform(head, at_once, [&](Transform& t) {
            t.matrix[static_cast<std::size_t>(coefficient & 3)] = static_cast<double>(coefficient >> 2) / 16777216;
        });
    }
    // With rotation, bit 31 tells the two kinds of words apart: 31 bits of offset or angle, or 15 bits each of x and y
    // (low, high).
    const auto word = static_cast<std::uint32_t>(m.memory[1]);
    const bool both = m.online_x && m.online_y;
    const auto sign_extended = [](std::uint32_t v, int bits) {
        return static_cast<double>(static_cast<std::int32_t>(v << (32 - bits)) >> (32 - bits));
    };
    double x = 0, y = 0;
    if (both)
        x = m.online_rot ? sign_extended(word, 15) : sign_extended(word, 16),
        y = m.online_rot ? sign_extended(word >> 15, 15) : sign_extended(word >> 16, 16);
    else
        x = y = m.online_rot ? sign_extended(word, 31) : sign_extended(word, 32);
    const double turn =
        m.online_rot
            ? std::fmod(static_cast<double>(static_cast<std::uint32_t>(m.memory[2]) & 0x7FFFFFFF) / m.online_resolution,
                        1.0) *
                  360
            : 0;
    return change_transform(head, at_once, [&](Transform& t) {
        if (m.online_x) t.offset.x = x * m.online_scale_x;
        if (m.online_y) t.offset.y = y * m.online_scale_y;
        if (m.online_rot) t.angle_deg = turn;
    });
}

void Engine::external_stop() {
    state_.startstop_info |= startstop_bit("STOP");
    stop_execution();
}

void Engine::encoder_sequence_error(int encoder) {
    raise(encoder == 0 ? marking_bit("ENCODER_X_SEQUENCE") : marking_bit("ENCODER_Y_SEQUENCE"), state_.tick);
}

std::uint32_t Engine::status() const {
    const Lists& l = state_.lists;
    return (l.running ? status_bit("BUSY") : 0) | (l.moving_alone ? status_bit("INTERNAL_BUSY") : 0) |
           (l.paused ? status_bit("PAUSED") : 0);
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

std::uint32_t Engine::get_startstop_info() {
    const auto out = static_cast<std::uint32_t>(state_.startstop_info);
    state_.startstop_info = 0;
    return out;
}

}  // namespace motionrack::rtc5
