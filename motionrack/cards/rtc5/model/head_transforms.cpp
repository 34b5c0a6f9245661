// Transforms positions for both heads and before the correction, and selects correction tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/head_transforms.hpp>

namespace motionrack::rtc5 {

namespace {

/// Updates the product Scale * Angle * Matrix, and whether the transform is the identity.
void multiply(Transform& t) {
    const SinCos turn = sin_cos(t.angle_deg * (pi / 180));
    const double c = t.scale * turn.cos, s = t.scale * turn.sin;
    const auto& m = t.matrix;
    t.product = {c * m[0] - s * m[2], c * m[1] - s * m[3], s * m[0] + c * m[2], s * m[1] + c * m[3]};
    t.neutral = t.product == std::array<double, 4>{1, 0, 0, 1} && t.offset.x == 0 && t.offset.y == 0;
}

}  // namespace

/// Changes the transforms of `head` (1 A, 2 B, 3 both, 4 global), now or from the next jump on.
template <class Change>
Result<void> HeadTransforms::change_transforms(std::string_view command, int head, int at_once, const Change& change) {
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

void HeadTransforms::begin_jump() {
    if (state_.later_count == 0) return;
    if (state_.later_count & 1) state_.heads[0].transform = state_.later[0];
    if (state_.later_count & 2) state_.heads[1].transform = state_.later[1];
    if (state_.later_count & 4) state_.global = state_.later[2];
    state_.later_count = 0;
}

Result<void> HeadTransforms::set_matrix(int head, std::array<double, 4> matrix, int at_once) {
    for (const double m : matrix) MOTIONRACK_CHECK(check_parameter("set_matrix", "a coefficient", m, Kind::factor));
    return change_transforms("set_matrix", head, at_once, [&](Transform& t) { t.matrix = matrix; });
}

Result<void> HeadTransforms::set_offset(int head, Point offset, int at_once) {
    MOTIONRACK_CHECK(check_parameter("set_offset", "XOffset", offset.x, Kind::centre));
    MOTIONRACK_CHECK(check_parameter("set_offset", "YOffset", offset.y, Kind::centre));
    return change_transforms("set_offset", head, at_once, [&](Transform& t) { t.offset = offset; });
}

Result<void> HeadTransforms::set_angle(int head, double degrees, int at_once) {
    MOTIONRACK_CHECK(check_parameter("set_angle", "Angle", degrees, Kind::angle));
    return change_transforms("set_angle", head, at_once, [&](Transform& t) { t.angle_deg = degrees; });
}

Result<void> HeadTransforms::set_scale(int head, double scale, int at_once) {
    MOTIONRACK_CHECK(check_parameter("set_scale", "Scale", scale, -16, 16));
    return change_transforms("set_scale", head, at_once, [&](Transform& t) { t.scale = scale; });
}

void HeadTransforms::take(const Command& c) {
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
    static_cast<void>(change_transforms(info(c.op).name, c.head, at_once, change));
}

Result<void> HeadTransforms::apply(const McBspReceiver& mcbsp, int head, int at_once) {
    return change_transforms("apply_mcbsp", head, at_once, [&](Transform& t) { mcbsp.apply_positioning(t); });
}

Result<void> HeadTransforms::load_table(std::shared_ptr<const Table> table, int number) {
    if (number < 1 || number > table_count)
        return fail(
            ErrorKind::refused,
            fmt::format("load_correction_file: table {} must be 1 to {}. Nothing was changed", number, table_count));
    tables_[static_cast<std::size_t>(number - 1)] = std::move(table);
    return {};
}

Result<void> HeadTransforms::select_tables(int head_a, int head_b) {
    for (const int number : {head_a, head_b})
        if (number < 0 || number > table_count)
            return fail(ErrorKind::refused,
                        fmt::format("select_cor_table: table {} must be 1 to {}, or 0. Nothing was changed", number,
                                    table_count));
    state_.heads[0].table = head_a;
    state_.heads[1].table = head_b;
    return {};
}

Result<void> HeadTransforms::set_hi(int head, Point gain, Point offset) {
    MOTIONRACK_CHECK(check_parameter("set_hi", "HeadNo", head, 1, 3));
    MOTIONRACK_CHECK(check_parameter("set_hi", "GalvoGainX", gain.x, -16, 16));
    MOTIONRACK_CHECK(check_parameter("set_hi", "GalvoGainY", gain.y, -16, 16));
    MOTIONRACK_CHECK(check_parameter("set_hi", "GalvoOffsetX", offset.x, min_field, max_field, "bits"));
    MOTIONRACK_CHECK(check_parameter("set_hi", "GalvoOffsetY", offset.y, min_field, max_field, "bits"));
    for (std::size_t i = 0; i < head_count; ++i)
        if (head >> i & 1) state_.heads[i].gain = gain, state_.heads[i].offset = offset;
    return {};
}

void HeadTransforms::run_head(std::size_t number, std::size_t n) {
    BlockBuffers& b = buffers_;
    const Head& head = state_.heads[number];
    const double *x = b.x.data(), *y = b.y.data();
    if (!head.transform.neutral) {
        std::copy_n(x, n, b.head_x.data());
        std::copy_n(y, n, b.head_y.data());
        kernels::transform(b.head_x.data(), b.head_y.data(), n, head.transform);
        x = b.head_x.data(), y = b.head_y.data();
    }
    kernels::head(x, y, b.out[2 * number].data(), b.out[2 * number + 1].data(), n, table(head.table), head.gain,
                  head.offset);
}

}  // namespace motionrack::rtc5
