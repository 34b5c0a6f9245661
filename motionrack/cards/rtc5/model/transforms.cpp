// Transforms of the heads and before the correction, including those received over McBSP.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

namespace {

/// Scale * Angle * Matrix, and whether it is the identity.
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
Result<void> Engine::change_transform(std::string_view command, int head, int at_once, const Change& change) {
    MOTIONRACK_CHECK(check_parameter(command, "HeadNo", head, Kind::head));
    MOTIONRACK_CHECK(check_parameter(command, "at_once", at_once, 0, 3));
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
    for (const double m : matrix) MOTIONRACK_CHECK(check_parameter("set_matrix", "a coefficient", m, Kind::factor));
    return change_transform("set_matrix", head, at_once, [&](Transform& t) { t.matrix = matrix; });
}

Result<void> Engine::set_offset(int head, Point offset, int at_once) {
    MOTIONRACK_CHECK(check_parameter("set_offset", "XOffset", offset.x, Kind::centre));
    MOTIONRACK_CHECK(check_parameter("set_offset", "YOffset", offset.y, Kind::centre));
    return change_transform("set_offset", head, at_once, [&](Transform& t) { t.offset = offset; });
}

Result<void> Engine::set_angle(int head, double degrees, int at_once) {
    MOTIONRACK_CHECK(check_parameter("set_angle", "Angle", degrees, Kind::angle));
    return change_transform("set_angle", head, at_once, [&](Transform& t) { t.angle_deg = degrees; });
}

Result<void> Engine::set_scale(int head, double scale, int at_once) {
    MOTIONRACK_CHECK(check_parameter("set_scale", "Scale", scale, -16, 16));
    return change_transform("set_scale", head, at_once, [&](Transform& t) { t.scale = scale; });
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
    static_cast<void>(change_transform(info(c.op).name, c.head, at_once, change));
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
    m.memory = {}, m.filled = 15;
    state_.fly = Fly{FlyKind::multi, 1, 1};
    state_.fly.scale_x = state_.fly.scale_y = 1;
    return {};
}

Result<void> Engine::set_mcbsp_online(double scale_x, double scale_y, double resolution) {
    if (!std::isfinite(scale_x) || !std::isfinite(scale_y) || !std::isfinite(resolution))
        return fail(ErrorKind::refused, "set_mcbsp_x, _y, _rot: a scale is not a number; nothing was changed");
    McBsp& m = state_.mcbsp;
    m.online_x = scale_x != 0, m.online_y = scale_y != 0, m.online_rot = std::abs(resolution) >= min_resolution;
    m.online_scale_x = scale_x, m.online_scale_y = scale_y, m.online_resolution = resolution;
    const FlyKind kind = state_.fly.kind;
    m.online_matrix = 0;
    if (!m.online()) return {};
    m.in_mode = m.multi = 0;
    if (kind == FlyKind::mcbsp || kind == FlyKind::mcbsp_rot || kind == FlyKind::multi) state_.fly = {};
    return {};
}

Result<void> Engine::set_mcbsp_x(double scale) {
    MOTIONRACK_CHECK(list_command(Op::set_mcbsp_x_list, {scale}));
    set_online(0, scale);
    return {};
}
Result<void> Engine::set_mcbsp_y(double scale) {
    MOTIONRACK_CHECK(list_command(Op::set_mcbsp_y_list, {scale}));
    set_online(1, scale);
    return {};
}
Result<void> Engine::set_mcbsp_rot(double resolution) {
    MOTIONRACK_CHECK(list_command(Op::set_mcbsp_rot_list, {resolution}));
    set_online(2, resolution);
    return {};
}

/// Sets X (0), Y (1) or the angle (2); the others are kept.
void Engine::set_online(std::size_t which, double value) {
    const McBsp& m = state_.mcbsp;
    std::array<double, 3> all{};
    if (!m.online_matrix)
        all = {m.online_x ? m.online_scale_x : 0, m.online_y ? m.online_scale_y : 0,
               m.online_rot ? m.online_resolution : 0};
    all[which] = value;
    static_cast<void>(set_mcbsp_online(all[0], all[1], all[2]));
}

Result<std::int32_t> Engine::get_mcbsp() {
    McBsp& m = state_.mcbsp;
    if (!m.received) return fail(ErrorKind::refused, fmt::format("get_mcbsp: {}", no_word_yet));
    m.put(0, static_cast<std::int32_t>(static_cast<std::uint32_t>(m.word)));
    return m.memory[0];
}

void Engine::set_mcbsp_matrix() {
    static_cast<void>(set_mcbsp_online(1, 0, 0));
    state_.mcbsp.online_matrix = 1;
}

Result<void> Engine::apply_mcbsp(int head, int at_once) {
    const McBsp& m = state_.mcbsp;
    if (m.online_matrix) {
        const std::int32_t coefficient = m.memory[1];
        return change_transform("apply_mcbsp", head, at_once, [&](Transform& t) {
            t.matrix[static_cast<std::size_t>(coefficient & 3)] = static_cast<double>(coefficient >> 2) / 16777216;
        });
    }
    // With rotation, bit 31 distinguishes the two kinds of words: 31 bits of offset or angle, or 15 bits each of x and
    // y (low, high).
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
    return change_transform("apply_mcbsp", head, at_once, [&](Transform& t) {
        if (m.online_x) t.offset.x = x * m.online_scale_x;
        if (m.online_y) t.offset.y = y * m.online_scale_y;
        if (m.online_rot) t.angle_deg = turn;
    });
}

}  // namespace motionrack::rtc5
