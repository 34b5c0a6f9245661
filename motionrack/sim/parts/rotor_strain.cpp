// Smoothed rate, and time until step loss.
#include <algorithm>
#include <cmath>
#include <motionrack/sim/parts/rotor_strain.hpp>

namespace motionrack::parts {

namespace {

/// Part of start_stop_hz: smaller rate changes are steps of a ramp.
constexpr double ramp_step = 0.125;
/// Bounds the time to step loss for a rate almost equal to that of the rotor.
constexpr double max_strain_s = 1e6;

}  // namespace

/// Along a ramp the rotor follows each step.
void RotorStrain::follow(double to) {
    if (state_.deadline == never) state_.steady_hz += to - motor_state_.rate_hz;
}

void RotorStrain::smooth(Instant now) {
    const double part = std::min(1.0, to_seconds(now - state_.steady_at) * 1e3);
    state_.steady_hz += (motor_state_.rate_hz - state_.steady_hz) * part;
    state_.steady_at = now;
}

bool RotorStrain::change_rate(double before, double rate, Instant now) {
    follow(before);  // along a curve the rate has drifted since the last notification
    motor_.note_rate(before);
    smooth(now);
    if (std::fabs(rate - before) <= ramp_step * motor_.settings().start_stop_hz) follow(rate);
    const double jump = std::fabs(rate - state_.steady_hz);
    if (motor_.in_step() && jump > motor_.settings().start_stop_hz) return true;
    state_.deadline = never;
    return false;
}

void RotorStrain::strain(double rate, std::int64_t pulses, Instant now) {
    RotorStrainState& s = state_;
    if (s.deadline == never) {
        s.rate_hz = s.steady_hz;
        s.since = now;
        s.pulses = pulses;
    }
    const double full_step = static_cast<double>(motor_.settings().microsteps);
    const double away = static_cast<double>(pulses - s.pulses) - s.rate_hz * to_seconds(now - s.since);
    const double margin = full_step - std::fabs(away), apart = std::fabs(rate - s.rate_hz);
    if (margin > 0 && apart == 0) {  // the pulses have returned to the rotor's rate before a step loss
        s.deadline = never;
        settle(rate, now);
    } else {
        s.deadline = now + from_seconds(margin > 0 ? std::min(margin / apart, max_strain_s) : 0);
    }
    motor_.note_rate(rate);
}

bool RotorStrain::survive(std::int64_t pulses, Instant now) {
    RotorStrainState& s = state_;
    s.deadline = never;
    const double mean = static_cast<double>(pulses - s.pulses) / std::max(1e-9, to_seconds(now - s.since));
    const bool followed = std::fabs(mean - s.rate_hz) <= motor_.settings().start_stop_hz;
    if (followed) settle(mean, now);
    return followed;
}

void RotorStrain::settle(double rate, Instant now) {
    state_.steady_hz = rate;
    state_.steady_at = now;
}

}  // namespace motionrack::parts
