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
    mcbsp_.begin_typed_words(port, factor, mode);
    state_.fly = Fly{FlyKind::multi, 1, 1};
    state_.fly.scale_x = state_.fly.scale_y = 1;
    return {};
}

Result<void> Engine::set_mcbsp_online(double scale_x, double scale_y, double resolution) {
    if (!std::isfinite(scale_x) || !std::isfinite(scale_y) || !std::isfinite(resolution))
        return fail(ErrorKind::refused, "set_mcbsp_x, _y, _rot: a scale is not a number; nothing was changed");
    const FlyKind kind = state_.fly.kind;
    const bool by_words = kind == FlyKind::mcbsp || kind == FlyKind::mcbsp_rot || kind == FlyKind::multi;
    if (mcbsp_.begin_positioning(scale_x, scale_y, resolution) && by_words) state_.fly = {};
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
    std::array<double, 3> all = mcbsp_.positioning_scales();
    all[which] = value;
    static_cast<void>(set_mcbsp_online(all[0], all[1], all[2]));
}

void Engine::set_mcbsp_matrix() {
    static_cast<void>(set_mcbsp_online(1, 0, 0));
    mcbsp_.position_by_matrix();
}

Result<void> Engine::apply_mcbsp(int head, int at_once) {
    return change_transform("apply_mcbsp", head, at_once, [&](Transform& t) { mcbsp_.apply_positioning(t); });
}

}  // namespace motionrack::rtc5
