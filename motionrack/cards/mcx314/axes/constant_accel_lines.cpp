// Segments of a trajectory: lines on which the speed changes linearly from one V to the next.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <motionrack/cards/mcx314/axes/segmenter.hpp>

namespace motionrack::mcx314 {

namespace {

// Pulses of a segment before its speed takes effect.
constexpr double spent_pulses = 0.6;

}  // namespace

/// Pulses of a move without those of its auxiliary.
Pulses4 Segmenter::delta_between(const PendingMove& work, const Pulses4& from, const Pulses4& to) {
    Pulses4 delta = {};
    for (std::size_t c = 0; c < delta.size(); ++c)
        if (static_cast<int>(c) != work.auxiliary) delta[c] = to[c] - from[c];
    return delta;
}

/// Pulses of the longest axis.
std::int64_t Segmenter::basic_pulses(const Pulses4& delta) {
    std::int64_t out = 0;
    for (const std::int64_t pulses : delta) out = std::max<std::int64_t>(out, std::llabs(pulses));
    return out;
}

/// Limits the speed at the end by the next move. At a reversal, rounding by half a pulse may leave a higher speed than
/// planned. The chip then stops there, as the velocity step would otherwise be doubled.
void Segmenter::look_at_next(PendingMove& work, const PendingMove& next) const {
    const Pulses4 delta = delta_between(next, work.to, next.to);
    work.max_at_end = max_on(delta, false).speed;
    double along = 0;
    for (std::size_t i = 0; i < control::axis_count; ++i)
        along += (work.move.move.end[i] - work.move.start[i]) * (next.move.move.end[i] - next.move.start[i]);
    work.turns_back = work.move.constant_accel && along < 0;
}

/// Computes the acceleration from the previous segment's final V to its own V, over its true pulses: on a curved path
/// the basic pulses per mm differ from segment to segment.
void Segmenter::make_even(const PendingMove& work, MoveSpeeds& speeds) {
    const double from = chain_open_ ? reached_ : speed_units(work.units_in, start_speed(work.path.tangent_in));
    const double to = speeds.top = speeds.exit = std::min(speeds.exit, work.max_at_end);
    const Pulses4 delta = delta_between(work, at_, work.to);
    const std::int64_t basic = basic_pulses(delta);
    if (basic == 0) return;
    // V units * seconds. The new speed takes effect from the host's first accesses after the junction.
    const double whole = (static_cast<double>(basic) - spent_pulses) / pulses_per_v_;
    const double length = std::max(0.5 * whole, whole - host_seconds_ * from);
    const double change = to * to - from * from, slope = std::fabs(change) / (2 * length);
    const std::int32_t max_accel = max_on(delta, false).acceleration;
    speeds.acceleration =
        std::clamp(static_cast<std::int32_t>(std::min(std::ceil(slope / rules::rate_unit), max_units)), 1, max_accel);
    const double changed = 2 * length * rules::rate_unit * speeds.acceleration;
    reached_ =
        changed >= std::fabs(change) ? to : std::sqrt(std::max(1.0, from * from + (change > 0 ? changed : -changed)));
}

}  // namespace motionrack::mcx314
