// Executes the commands of the correction, and corrects blocks and single positions.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/fly_correction.hpp>

namespace motionrack::rtc5 {

namespace {

Point through(const Transform& t, Point p) {
    if (t.neutral) return p;
    return {t.product[0] * p.x + t.product[1] * p.y + t.offset.x, t.product[2] * p.x + t.product[3] * p.y + t.offset.y};
}

}  // namespace

void FlyCorrection::take(const Command& c) {
    Fly& f = state_.now;
    const auto axis = [&](FlyKind kind, bool y) {
        be_kind(kind);
        (y ? f.y : f.x) = c.p[0] != 0;
        (y ? f.scale_y : f.scale_x) = c.p[0];
    };
    const auto both = [&](FlyKind kind) {
        be_kind(kind);
        f.x = c.p[0] != 0, f.y = c.p[1] != 0;
        f.scale_x = c.p[0], f.scale_y = c.p[1];
    };
    switch (c.op) {
        case Op::set_fly_x:
            axis(FlyKind::encoder, false);
            break;
        case Op::set_fly_y:
            axis(FlyKind::encoder, true);
            break;
        case Op::set_fly_x_pos:
            axis(FlyKind::mcbsp, false);
            break;
        case Op::set_fly_y_pos:
            axis(FlyKind::mcbsp, true);
            break;
        case Op::set_fly_z:
            be_kind(FlyKind::encoder);
            f.z = c.p[0] != 0, f.scale_z = c.p[0], f.z_encoder = static_cast<std::int64_t>(c.p[1]);
            break;
        case Op::set_fly_rot:
            return turn(FlyKind::encoder_rot, c.p[0]);
        case Op::set_fly_rot_pos:
            return turn(FlyKind::mcbsp_rot, c.p[0]);
        case Op::activate_fly_xy:
            both(FlyKind::encoder);
            break;
        case Op::activate_fly_2d:
            if (table_ == nullptr) return flags_.raise(marking_bit("ACTIVATE_FLY_ERROR"), tick_);
            both(FlyKind::encoder_2d);
            break;
        default:
            both(FlyKind::encoder_2d);
            break;
    }
    settle_kind();
}

void FlyCorrection::be_kind(FlyKind kind) {
    if (state_.now.kind != kind) state_.now = Fly{kind};
}

void FlyCorrection::settle_kind() {
    const Fly& f = state_.now;
    if (!f.x && !f.y && !f.z) state_.now = Fly{};
}

void FlyCorrection::turn(FlyKind kind, double resolution) {
    state_.now = Fly{};
    if (std::abs(resolution) < min_resolution) return;
    state_.now.kind = kind;
    state_.now.resolution = resolution;
}

void FlyCorrection::correct_axes(int mode, double scale) {
    mcbsp_.begin_axis_correction(mode);
    state_.now = Fly{FlyKind::mcbsp, mode & 1, mode >> 1 & 1};
    state_.now.scale_x = state_.now.scale_y = scale;
    if (scale == 0) state_.now = Fly{};
    settle_kind();
}

Result<void> FlyCorrection::set_mcbsp_in(int mode, double scale) {
    MOTIONRACK_CHECK(list_command(Op::set_mcbsp_in_list, {static_cast<double>(mode), scale}));
    correct_axes(mode, scale);
    return {};
}

Result<void> FlyCorrection::set_multi_mcbsp_in(int port, std::int64_t factor, int mode) {
    MOTIONRACK_CHECK(list_command(Op::set_multi_mcbsp_in_list,
                                  {static_cast<double>(port), static_cast<double>(factor), static_cast<double>(mode)}));
    mcbsp_.begin_typed_words(port, factor, mode);
    state_.now = Fly{FlyKind::multi, 1, 1};
    state_.now.scale_x = state_.now.scale_y = 1;
    return {};
}

Result<void> FlyCorrection::set_mcbsp_online(double scale_x, double scale_y, double resolution) {
    if (!std::isfinite(scale_x) || !std::isfinite(scale_y) || !std::isfinite(resolution))
        return fail(ErrorKind::refused, "set_mcbsp_x, _y, _rot: a scale is not a number; nothing was changed");
    const FlyKind kind = state_.now.kind;
    const bool by_words = kind == FlyKind::mcbsp || kind == FlyKind::mcbsp_rot || kind == FlyKind::multi;
    if (mcbsp_.begin_positioning(scale_x, scale_y, resolution) && by_words) state_.now = {};
    return {};
}

Result<void> FlyCorrection::set_mcbsp_x(double scale) {
    MOTIONRACK_CHECK(list_command(Op::set_mcbsp_x_list, {scale}));
    set_online(0, scale);
    return {};
}
Result<void> FlyCorrection::set_mcbsp_y(double scale) {
    MOTIONRACK_CHECK(list_command(Op::set_mcbsp_y_list, {scale}));
    set_online(1, scale);
    return {};
}
Result<void> FlyCorrection::set_mcbsp_rot(double resolution) {
    MOTIONRACK_CHECK(list_command(Op::set_mcbsp_rot_list, {resolution}));
    set_online(2, resolution);
    return {};
}

void FlyCorrection::set_online(std::size_t which, double value) {
    std::array<double, 3> all = mcbsp_.positioning_scales();
    all[which] = value;
    static_cast<void>(set_mcbsp_online(all[0], all[1], all[2]));
}

void FlyCorrection::set_mcbsp_matrix() {
    static_cast<void>(set_mcbsp_online(1, 0, 0));
    mcbsp_.position_by_matrix();
}

Result<void> FlyCorrection::set_rot_center(Point centre) {
    MOTIONRACK_CHECK(check_parameter("set_rot_center", "X", centre.x, Kind::centre));
    MOTIONRACK_CHECK(check_parameter("set_rot_center", "Y", centre.y, Kind::centre));
    state_.rot_center = centre;
    return {};
}

void FlyCorrection::zero_2d(std::int32_t offset_x, std::int32_t offset_y) {
    for (std::size_t e = 0; e < encoder_count; ++e) encoders_.zero(e);
    state_.offset_2d = {static_cast<double>(offset_x), static_cast<double>(offset_y)};
}

PlanExtent FlyCorrection::check(std::size_t n) {
    const PlanExtent extent = kernels::extent(buffers_.x.data(), buffers_.y.data(), n);
    flags_.check(buffers_, extent, tick_);
    check_z(n);
    return extent;
}

double FlyCorrection::output_z(std::size_t n) const {
    const bool moves = state_.now.z || state_.now.kind == FlyKind::multi;
    return std::clamp(n > 1 && moves ? block_z_ : z_now(), min_z, max_z);
}

void FlyCorrection::apply(std::size_t n) {
    BlockBuffers& b = buffers_;
    const Fly& f = state_.now;
    const bool turns = f.kind == FlyKind::encoder_rot || f.kind == FlyKind::mcbsp_rot;
    if (f.kind == FlyKind::encoder || f.kind == FlyKind::encoder_2d || f.kind == FlyKind::encoder_rot) {
        if (f.x || turns || f.kind == FlyKind::encoder_2d) encoders_.load_effective(0, n);
        if (f.y || f.kind == FlyKind::encoder_2d) encoders_.load_effective(1, n);
    } else {
        mcbsp_.load_values(n);
    }
    if (turns) {
        const Point centre = state_.rot_center;
        for (std::size_t i = 0; i < n; ++i) {
            const SinCos t = sin_cos(turn_of(b.effective[0][i], f.resolution));
            const double dx = b.x[i] - centre.x, dy = b.y[i] - centre.y;
            b.x[i] = centre.x + (t.cos * dx - t.sin * dy);
            b.y[i] = centre.y + (t.sin * dx + t.cos * dy);
        }
        return;
    }
    if (f.kind == FlyKind::encoder_2d) {
        for (std::size_t i = 0; i < n; ++i) {
            b.effective[0][i] += state_.offset_2d.x;
            b.effective[1][i] += state_.offset_2d.y;
            if (table_ == nullptr) continue;
            const FlyTable::Shift shift = table_->at(b.effective[0][i], b.effective[1][i]);
            b.effective[0][i] += shift.x;
            b.effective[1][i] += shift.y;
        }
    }
    if (f.x) kernels::add_scaled(b.x.data(), b.effective[0].data(), n, f.scale_x);
    if (f.y) kernels::add_scaled(b.y.data(), b.effective[1].data(), n, f.scale_y);
}

void FlyCorrection::check_z(std::size_t n) {
    const Fly& f = state_.now;
    const bool multi = f.kind == FlyKind::multi;
    if (!f.z && !multi) return;
    const auto encoder = static_cast<std::size_t>(f.z_encoder);
    if (f.z) encoders_.load_effective(encoder, n);
    double at_type2 = static_cast<double>(mcbsp_.typed(2));
    const bool many = multi && n > 1 && mcbsp_.load_words(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (many && i > 0 && (buffers_.words[i] & 7) == 2)
            at_type2 = static_cast<double>(static_cast<std::int32_t>(buffers_.words[i]) >> 3);
        const double z = multi ? z_ + at_type2 : z_ + f.scale_z * buffers_.effective[encoder][i];
        flags_.check_z(z, tick_ + static_cast<std::int64_t>(i));
        block_z_ = z;
    }
}

/// Returns Z in the last tick with sampled inputs.
double FlyCorrection::z_now() const {
    const Fly& f = state_.now;
    if (f.kind == FlyKind::multi) return z_ + static_cast<double>(mcbsp_.typed(2));
    return f.z ? z_ + f.scale_z * encoders_.effective(static_cast<std::size_t>(f.z_encoder)) : z_;
}

/// Returns `p` after the correction of this tick; `backwards`: returns the position that the correction maps to `p`.
Point FlyCorrection::shifted(Point p, bool backwards) const {
    const Fly& f = state_.now;
    double value[2] = {0, 0};
    switch (f.kind) {
        case FlyKind::off:
            return p;
        case FlyKind::encoder:
        case FlyKind::encoder_rot:
            value[0] = encoders_.effective(0), value[1] = encoders_.effective(1);
            break;
        case FlyKind::encoder_2d: {
            const double a = encoders_.effective(0) + state_.offset_2d.x,
                         b = encoders_.effective(1) + state_.offset_2d.y;
            const FlyTable::Shift shift = table_ != nullptr ? table_->at(a, b) : FlyTable::Shift{};
            value[0] = a + shift.x, value[1] = b + shift.y;
            break;
        }
        default: {
            const Point now = mcbsp_.now();
            value[0] = now.x, value[1] = now.y;
        }
    }
    if (f.kind == FlyKind::encoder_rot || f.kind == FlyKind::mcbsp_rot) {
        const SinCos t = sin_cos(turn_of(value[0], f.resolution));
        const double s = backwards ? -t.sin : t.sin, c = t.cos;
        const Point d = p - state_.rot_center;
        return {state_.rot_center.x + (c * d.x - s * d.y), state_.rot_center.y + (s * d.x + c * d.y)};
    }
    const double sign = backwards ? -1 : 1;
    if (f.x) p.x += sign * (f.scale_x * value[0]);
    if (f.y) p.y += sign * (f.scale_y * value[1]);
    return p;
}

/// Adds the correction to `p`, so that it can be switched off without a jump of the output; `backwards`: subtracts it.
Point FlyCorrection::moved(Point p, const Transform& global, bool backwards) const {
    if (!on()) return p;
    const Point g = through(global, p), offset = shifted(g, backwards) - g;
    return {clipped(p.x + offset.x, Kind::coordinate), clipped(p.y + offset.y, Kind::coordinate)};
}

Point FlyCorrection::leave(Point p, const Transform& global) {
    p = moved(p, global, false);
    state_.now = Fly{};
    state_.paused = Fly{};
    state_.parked = 0;
    return p;
}

Point FlyCorrection::park(Point p, const Transform& global, bool pause) {
    state_.park_from = p;
    if (!pause || !on()) return p;
    const Fly paused = state_.now;
    p = leave(p, global);
    state_.paused = paused;
    state_.parked = 1;
    return p;
}

Point FlyCorrection::end_parking(Point p, const Transform& global) {
    if (!state_.parked) return p;
    state_.now = state_.paused;
    state_.parked = 0;
    return moved(p, global, true);
}

// Evaluates three ticks: the first, which uses the sampled counts, the second and the last. In between, positions and
// counts are linear in time.
std::optional<PlanExtent> FlyCorrection::steady_extent(const Activity& a, bool moves, Point p, std::int64_t n) const {
    const Fly& f = state_.now;
    const bool encoders = f.kind == FlyKind::encoder;
    if ((!encoders && f.kind != FlyKind::mcbsp) || f.z || a.kind == ActivityKind::arc) return std::nullopt;
    for (std::size_t axis = 0; axis < encoder_count; ++axis) {
        const BeltCounter& e = encoders_.counter(axis);
        if (encoders && e.simulated && e.count() + simulated_counts * std::min<std::int64_t>(n, 1 << 29) > 2147483647)
            return std::nullopt;
    }
    if (n > 1 << 28) return std::nullopt;
    const Point words = mcbsp_.now();
    const auto value = [&](std::size_t axis, std::int64_t i) {
        if (!encoders) return axis == 0 ? words.x : words.y;
        const BeltCounter& e = encoders_.counter(axis);
        if (i == 0) return encoders_.effective(axis);
        const double each = e.simulated ? simulated_counts : 0;
        return e.count() + each * static_cast<double>(i) + each * static_cast<double>(encoders_.tracking_error(axis));
    };
    PlanExtent out;
    for (const std::int64_t i : {std::int64_t{0}, std::min<std::int64_t>(1, n - 1), n - 1}) {
        const Point at = moves ? a.position(a.done + i + 1, p) : p;
        const Point q = {f.x ? at.x + f.scale_x * value(0, i) : at.x, f.y ? at.y + f.scale_y * value(1, i) : at.y};
        if (!flags_.is_inside(q.x, 0) || !flags_.is_inside(q.y, 1)) return std::nullopt;
        out.take({q.x, q.x, q.y, q.y});
    }
    return out;
}

}  // namespace motionrack::rtc5
