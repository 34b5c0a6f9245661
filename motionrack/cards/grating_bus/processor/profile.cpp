// Composes profiles of jerk-limited velocity changes.
#include <algorithm>
#include <cmath>
#include <motionrack/base/result.hpp>
#include <motionrack/cards/grating_bus/processor/profile.hpp>

namespace motionrack::grating_bus {

SpeedChange::SpeedChange(double from_nm_s, double to_nm_s, const MotionLimits& limits)
    : from_(from_nm_s), to_(to_nm_s) {
    const double change = std::fabs(to_ - from_), accel = limits.accel_nm_s2, jerk = limits.jerk_nm_s3;
    if (change == 0) return;
    jerk_ = to_ > from_ ? jerk : -jerk;
    jerk_s_ = accel / jerk;
    accel_s_ = change / accel - jerk_s_;
    if (accel_s_ >= 0) return;
    jerk_s_ = std::sqrt(change / jerk);
    accel_s_ = 0;
}

Setpoint SpeedChange::at(double seconds) const {
    const double t = std::clamp(seconds, 0.0, duration());
    const double accel = jerk_ * jerk_s_, speed_1 = from_ + accel * jerk_s_ / 2;
    if (t <= jerk_s_) return {t * (from_ + jerk_ * t * t / 6), from_ + jerk_ * t * t / 2, jerk_ * t};
    if (t < jerk_s_ + accel_s_) {
        const double place_1 = jerk_s_ * (from_ + accel * jerk_s_ / 6), u = t - jerk_s_;
        return {place_1 + u * (speed_1 + accel * u / 2), speed_1 + accel * u, accel};
    }
    const double left = duration() - t;  // the last jerk phase mirrors the first
    return {distance() - left * (to_ - jerk_ * left * left / 6), to_ - jerk_ * left * left / 2, jerk_ * left};
}

// ---- scan

ScanProfile::ScanProfile(double from_nm, double to_nm, const MotionLimits& limits)
    : from_(from_nm),
      to_(to_nm),
      speed_(limits.speed_nm_s),
      line_s_((to_nm - from_nm) / limits.speed_nm_s),
      start_(0, limits.speed_nm_s, limits),
      turn_(limits.speed_nm_s, -limits.speed_nm_s, limits) {
    MOTIONRACK_ASSERT(from_nm < to_nm && limits.speed_nm_s > 0 && limits.accel_nm_s2 > 0 && limits.jerk_nm_s3 > 0);
}

/// Returns the time within the present period of the scan, 0 .. period_s().
double ScanProfile::phase(double seconds) const {
    const double t = seconds - start_.duration(), period = period_s();
    return t - std::floor(t / period) * period;
}

Setpoint ScanProfile::at(double seconds) const {
    if (seconds < 0) return {start_nm(), 0, 0};
    if (seconds < start_.duration()) {
        Setpoint out = start_.at(seconds);
        out.position_nm += start_nm();
        return out;
    }
    double t = phase(seconds);
    const double half = period_s() / 2;
    const bool back = t >= half;
    if (back) t -= half;
    const double sign = back ? -1 : 1;
    Setpoint out = t < line_s_ ? Setpoint{speed_ * t, speed_, 0} : turn_.at(t - line_s_);
    if (t >= line_s_) out.position_nm += to_ - from_;
    out = geared(out, sign);
    out.position_nm += back ? to_ : from_;
    return out;
}

bool ScanProfile::scanning(double seconds) const {
    if (seconds < start_.duration()) return false;
    const double t = phase(seconds), half = period_s() / 2;
    return (t >= half ? t - half : t) < line_s_;
}

// ---- steps

StepProfile::StepProfile(double start_nm, double step_nm, int steps, double every_s, const MotionLimits& limits)
    : start_(start_nm), step_(step_nm), steps_(steps), every_(every_s) {
    const double distance = std::fabs(step_nm);
    MOTIONRACK_ASSERT(distance > 0 && steps > 0 && limits.speed_nm_s > 0 && limits.accel_nm_s2 > 0 &&
                      limits.jerk_nm_s3 > 0);
    const auto both = [&](double speed) { return 2 * SpeedChange(0, speed, limits).distance(); };
    speed_ = limits.speed_nm_s;
    if (both(speed_) > distance) {  // the highest velocity that still leaves the distance to stop
        double low = 0;
        for (int i = 0; i < 100; ++i) {
            const double middle = (low + speed_) / 2;
            (both(middle) > distance ? speed_ : low) = middle;
        }
        speed_ = low;
    }
    up_ = SpeedChange(0, speed_, limits);
    down_ = SpeedChange(speed_, 0, limits);
    line_s_ = (distance - 2 * up_.distance()) / speed_;
    MOTIONRACK_ASSERT(every_s >= move_s());
}

Setpoint StepProfile::at(double seconds) const {
    if (seconds < 0) return {start_, 0, 0};
    const double number = std::floor(seconds / every_), t = seconds - number * every_;
    const double row = std::floor(number / steps_), in_row = number - row * steps_;
    const bool down = row - std::floor(row / 2) * 2 != 0;
    Setpoint out{std::fabs(step_), 0, 0};
    if (t < up_.duration()) {
        out = up_.at(t);
    } else if (t < up_.duration() + line_s_) {
        out = {up_.distance() + speed_ * (t - up_.duration()), speed_, 0};
    } else if (t < move_s()) {
        out = down_.at(t - up_.duration() - line_s_);
        out.position_nm += up_.distance() + speed_ * line_s_;
    }
    const double sign = (step_ < 0) != down ? -1 : 1;
    out = geared(out, sign);
    out.position_nm += start_ + step_ * (down ? steps_ - in_row : in_row);
    return out;
}

double StepProfile::settled_s(double seconds) const {
    return seconds - std::floor(seconds / every_) * every_ - move_s();
}

}  // namespace motionrack::grating_bus
