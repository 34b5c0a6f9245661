// The laws of sessions, one function each.
#include <fmt/format.h>

#include <cmath>
#include <tests/invariants/session_laws.hpp>
#include <utility>

namespace motionrack::test {

namespace {

/// Minimum interval of mean velocities.
constexpr double min_seconds = 0.01;

}  // namespace

SessionLaws::SessionLaws(std::vector<SessionAxis> axes, SessionPicture now, Report report)
    : axes_(std::move(axes)), report_(std::move(report)), last_(std::move(now)), velocities_(axes_.size()) {}

void SessionLaws::see_time(const SessionPicture& now) {
    if (now.ns < last_.ns) report_(fmt::format("time went back from {} ns to {} ns", last_.ns, now.ns));
}

void SessionLaws::see(const SessionPicture& now) {
    see_time(now);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const std::int64_t sent = now.pulses[i] - last_.pulses[i], counted = now.counters[i] - last_.counters[i];
        if (!ordered_ && static_cast<std::int32_t>(sent - counted) != 0)  // counters have 32 bits
            report_(fmt::format("axis {} was sent {} pulses and its counter went by {}, up to {} ns", axes_[i].letter,
                                sent, counted, now.ns));
        if (rests_ && sent != 0)
            report_(
                fmt::format("axis {} was sent {} pulses without an order, up to {} ns", axes_[i].letter, sent, now.ns));
    }
    last_ = now;
    ordered_ = false;
}

void SessionLaws::ordered() {
    ordered_ = true;
    rests_ = false;
}

void SessionLaws::begin_drive() {
    velocities_.assign(axes_.size(), 0);
    last_seconds_ = 0;
    jump_.clear();
}

void SessionLaws::during_drive(const SessionPicture& now) {
    see_time(now);
    const double seconds = static_cast<double>(now.ns - last_.ns) * 1e-9;
    if (seconds < min_seconds) return;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        const double velocity =
            static_cast<double>(now.pulses[i] - last_.pulses[i]) / axes_[i].pulses_per_unit / seconds;
        see_limits(i, velocity, seconds);
        velocities_[i] = velocity;
    }
    last_seconds_ = seconds;
    last_ = now;
}

void SessionLaws::see_limits(std::size_t axis, double velocity, double seconds) {
    const SessionAxis& own = axes_[axis];
    const auto rounding = [&](double interval) { return 2 / (own.pulses_per_unit * interval); };
    if (std::fabs(velocity) > own.max_velocity * 1.01 + rounding(seconds))
        report_(fmt::format("axis {} went at {:g} a second, above its {:g}", own.letter, velocity, own.max_velocity));
    if (last_seconds_ == 0 || !jump_.empty()) return;
    const double change = std::fabs(velocity - velocities_[axis]);
    const double allowed = own.max_accel * 1.05 * (seconds + last_seconds_) / 2 + own.velocity_step * 1.15 +
                           rounding(seconds) + rounding(last_seconds_);
    if (change > allowed)
        jump_ = fmt::format("the velocity of axis {} changed from {:g} to {:g} a second; its limits explain {:g}",
                            own.letter, velocities_[axis], velocity, allowed);
}

/// Reports a velocity change only if the program ran to its end: a stop may end the pulses without a ramp.
void SessionLaws::end_drive(const SessionPicture& now, bool moved, bool whole) {
    see_time(now);
    if (whole && !jump_.empty()) report_(jump_);
    if (moved) rests_ = true;
    last_ = now;
    ordered_ = false;
}

}  // namespace motionrack::test
