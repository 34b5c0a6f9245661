// Evaluates windows of pulses after a stop.
#include <algorithm>
#include <cmath>
#include <motionrack/rack/rack.hpp>
#include <motionrack/rack/ramp_watch.hpp>
#include <span>
#include <utility>

namespace motionrack::rack {

RampWatch::RampWatch(Rack& rack)
    : rack_(rack), kernel_(rack.kernel()), id_(kernel_.add(*this, sim::Phase::observers, "ramps")) {
    for (std::size_t a = 0; a < rack_.axes().size(); ++a) {
        const RackAxis& axis = rack_.axes()[a].config;
        if (rack_.axes()[a].servo || rack_.config().positions_alone(axis)) continue;
        const double units = axis.pulses_per_unit();
        const JumpLaw law(axis.max_velocity_step * units, axis.max_accel * units, period);
        if (law.samples > 0) watched_.push_back({a, law});
    }
}

std::int64_t RampWatch::count_of(std::size_t i, Instant now) const {
    return rack_.axes()[watched_[i].axis].turned_by().count(now);
}

double RampWatch::rate_of(std::size_t i, Instant now) const {
    return rack_.axes()[watched_[i].axis].turned_by().rate(now);
}

/// Assumes that each axis has had its present rate before.
void RampWatch::arm(Instant now) {
    state_ = {};
    state_.watches = 1;
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        const double each = rate_of(i, now) * to_seconds(period);
        const std::int64_t count = count_of(i, now);
        for (std::size_t k = 0; k < counts_kept; ++k)
            state_.counts[i][k] = count - std::llround(each * static_cast<double>(counts_kept - 1 - k));
    }
    if (!watched_.empty()) kernel_.schedule(id_, later(now, period));
}

void RampWatch::keep(std::size_t i, std::int64_t count) {
    std::array<std::int64_t, counts_kept>& counts = state_.counts[i];
    std::rotate(counts.begin(), counts.begin() + 1, counts.end());
    counts.back() = count;
}

/// Returns true if the pulses have ended without a ramp. In a dense path, an axis may have no pulse in one segment, and
/// more than its share in the one before: while other axes move, nothing must follow within a window.
bool RampWatch::ends_abruptly(std::size_t i, Instant now) {
    const JumpLaw& law = watched_[i].law;
    const double rate = std::fabs(rate_of(i, now)), before = std::exchange(state_.rates[i], rate);
    if (rate != 0) {
        state_.rest_looks[i] = 0;
        return false;
    }
    if (state_.rest_looks[i]++ == 0) {
        state_.rests_from[i] = now;
        state_.ended_hz[i] = std::min(before, law.max_hz(std::span{state_.counts[i]}.first(counts_kept - 1)));
    }
    const bool others_move = std::any_of(watched_.begin(), watched_.end(), [&](const SteppedAxis& one) {
        return rack_.axes()[one.axis].turned_by().rate(now) != 0;
    });
    if (others_move && state_.rest_looks[i] < static_cast<std::int64_t>(law.samples)) return false;
    return std::exchange(state_.ended_hz[i], 0) > law.end_hz;
}

void RampWatch::judge(std::size_t i, Instant now) {
    const std::array<std::int64_t, counts_kept>& counts = state_.counts[i];
    const std::size_t samples = watched_[i].law.samples, last = counts_kept - 1;
    Instant& jumped = state_.jumped[static_cast<std::size_t>(rack_.axes()[watched_[i].axis].config.index())];
    if (ends_abruptly(i, now)) jumped = std::max(jumped, state_.rests_from[i] + Duration{1});
    if (watched_[i].law.jump_hz(counts[last - 2 * samples], counts[last - samples], counts[last]) > 0)
        jumped = now + Duration{1};
}

void RampWatch::on_scheduled(Instant now) {
    kernel_.schedule(id_, later(now, period));
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        keep(i, count_of(i, now));
        judge(i, now);
    }
}

/// Continues the windows over the time without a driver.
void RampWatch::settle() {
    if (state_.watches == 0) return;
    state_.watches = 0;
    kernel_.schedule(id_, never);
    const Instant now = kernel_.now();
    for (std::size_t i = 0; i < watched_.size(); ++i) {
        const std::int64_t count = count_of(i, now);
        for (std::size_t k = 0; k < 2 * watched_[i].law.samples; ++k) {
            keep(i, count);
            judge(i, now);
        }
    }
}

void RampWatch::look_back(Instant now) {
    begin(std::max(now - looks_back, Instant{}));
    settle();
}

void RampWatch::end() {
    state_ = {};
    kernel_.schedule(id_, never);
}

}  // namespace motionrack::rack
