// Computation of outputs from positions, block by block.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/cards/rtc5/model/engine.hpp>

namespace motionrack::rtc5 {

void Engine::run_pipeline(std::size_t n, Sink* sink) {
    BlockBuffers& b = *buffers_;
    laser_.run_until(state_.tick + static_cast<std::int64_t>(n));
    heads_.transform_block(n);
    if (state_.fly.on()) {
        apply_fly(n);
        const PlanExtent extent = kernels::extent(b.x.data(), b.y.data(), n);
        extent_.take(extent);
        flags_.check(b, extent, state_.tick);
        check_z(n);
    }
    const bool recorded = samples_now();
    if (sink == nullptr && !recorded) {
        evaluated_ = false;
        return;
    }
    heads_.run_head(0, n);
    const bool second = heads_.second_head();
    if (second) heads_.run_head(1, n);
    keep_output(n);
    if (recorded) record();
    if (sink == nullptr) return;
    const auto ints = [&](std::size_t i) { return std::span<const std::int32_t>(b.out[i].data(), n); };
    sink->samples({state_.tick, ints(0), ints(1), second ? ints(2) : std::span<const std::int32_t>{},
                   second ? ints(3) : std::span<const std::int32_t>{}, std::span<const std::uint8_t>(b.laser.data(), n),
                   state_.fly.on() ? std::span<const double>(b.x.data(), n) : std::span<const double>{},
                   state_.fly.on() ? std::span<const double>(b.y.data(), n) : std::span<const double>{}});
}

void Engine::apply_fly(std::size_t n) {
    BlockBuffers& b = *buffers_;
    const Fly& f = state_.fly;
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
            b.effective[0][i] += state_.fly_2d_offset.x;
            b.effective[1][i] += state_.fly_2d_offset.y;
            if (fly_table_ == nullptr) continue;
            const FlyTable::Shift shift = fly_table_->at(b.effective[0][i], b.effective[1][i]);
            b.effective[0][i] += shift.x;
            b.effective[1][i] += shift.y;
        }
    }
    if (f.x) kernels::add_scaled(b.x.data(), b.effective[0].data(), n, f.scale_x);
    if (f.y) kernels::add_scaled(b.y.data(), b.effective[1].data(), n, f.scale_y);
}

void Engine::check_z(std::size_t n) {
    const Fly& f = state_.fly;
    const bool multi = f.kind == FlyKind::multi;
    if (!f.z && !multi) return;
    const auto encoder = static_cast<std::size_t>(f.z_encoder);
    if (f.z) encoders_.load_effective(encoder, n);
    double at_type2 = static_cast<double>(mcbsp_.typed(2));
    const bool many = multi && n > 1 && mcbsp_.load_words(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (many && i > 0 && (buffers_->words[i] & 7) == 2)
            at_type2 = static_cast<double>(static_cast<std::int32_t>(buffers_->words[i]) >> 3);
        const double z = multi ? state_.z + at_type2 : state_.z + f.scale_z * buffers_->effective[encoder][i];
        flags_.check_z(z, state_.tick + static_cast<std::int64_t>(i));
        block_z_ = z;
    }
}

/// Z in the last sampled tick.
double Engine::z_now() const {
    const Fly& f = state_.fly;
    if (f.kind == FlyKind::multi) return state_.z + static_cast<double>(mcbsp_.typed(2));
    return f.z ? state_.z + f.scale_z * encoders_.effective(static_cast<std::size_t>(f.z_encoder)) : state_.z;
}

/// Output of the last of n ticks.
void Engine::keep_output(std::size_t n) {
    const BlockBuffers& b = *buffers_;
    HeadOutput& o = state_.output;
    o.a = {b.out[0][n - 1], b.out[1][n - 1]};
    o.b = heads_.second_head() ? std::array<std::int32_t, 2>{b.out[2][n - 1], b.out[3][n - 1]}
                               : std::array<std::int32_t, 2>{};
    o.corrected = {b.x[n - 1], b.y[n - 1]};
    const bool moves = state_.fly.z || state_.fly.kind == FlyKind::multi;
    o.z = std::clamp(n > 1 && moves ? block_z_ : z_now(), min_z, max_z);
    evaluated_ = true;
}

/// Computes the output of the last tick if it was skipped.
void Engine::evaluate() {
    if (evaluated_) return;
    BlockBuffers& b = *buffers_;
    const Point p = state_.p + wobbel_.offset();
    b.x[0] = p.x, b.y[0] = p.y;
    heads_.transform_block(1);
    if (state_.fly.on()) apply_fly(1);
    heads_.run_head(0, 1);
    if (heads_.second_head()) heads_.run_head(1, 1);
    keep_output(1);
}

/// Extent of n ticks of the activity, if it is far enough inside field and limits that no flag can be set. Positions
/// and counts are linear in time, so their end points suffice.
std::optional<PlanExtent> Engine::steady_extent(const Activity& a, std::int64_t n) const {
    const Fly& f = state_.fly;
    const bool encoders = f.kind == FlyKind::encoder;
    if ((!encoders && f.kind != FlyKind::mcbsp) || f.z || a.kind == ActivityKind::arc || !heads_.global().neutral ||
        connections_.inputs != nullptr)
        return std::nullopt;
    for (const BeltCounter& e : state_.encoders.counters)
        if (encoders && e.simulated && e.count() + simulated_counts * std::min<std::int64_t>(n, 1 << 29) > 2147483647)
            return std::nullopt;
    if (n > 1 << 28) return std::nullopt;
    const bool moves = a.kind == ActivityKind::line && !state_.lists.paused;
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
        const Point p = moves ? a.position(a.done + i + 1, state_.p) : state_.p;
        const Point q = {f.x ? p.x + f.scale_x * value(0, i) : p.x, f.y ? p.y + f.scale_y * value(1, i) : p.y};
        if (!flags_.is_inside(q.x, 0) || !flags_.is_inside(q.y, 1)) return std::nullopt;
        out.take({q.x, q.x, q.y, q.y});
    }
    return out;
}

}  // namespace motionrack::rtc5
