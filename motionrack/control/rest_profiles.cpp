// Closed forms of the trapezoidal and the double-S profile; the distance selects the case.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <motionrack/control/rest_profiles.hpp>

namespace motionrack::control {

double cube_root(double x) {
    if (!(x >= 1e-290)) return x > 0 ? cube_root(x * 0x1p+300) * 0x1p-100 : 0;
    // Start: y ~ x^(-1/3) from a third of the exponent (x y^3 within 0.103 of 1). Then two steps of fourth order,
    // without division.
    double y = std::bit_cast<double>(0x553EE80000000000u - std::bit_cast<std::uint64_t>(x) / 3);
    for (int step = 0; step < 2; ++step) {
        const double h = 1 - x * y * (y * y);
        y += y * h * (1.0 / 3 + h * (2.0 / 9 + h * (14.0 / 81)));
    }
    return x * y * y;
}

TrapezoidalProfile::TrapezoidalProfile(double distance, double velocity, double accel)
    : distance_(distance), accel_(accel) {
    const double reach = accel * distance;
    if (reach > velocity * velocity) {
        cruise_at(velocity);
        return;
    }
    peak_ = std::sqrt(reach);
    cruise_from_ = cruise_until_ = peak_ / accel;
    cruise_start_ = 0.5 * distance;
    duration_ = 2 * cruise_from_;
}

TrapezoidalProfile::TrapezoidalProfile(double distance, double entry, double exit, double velocity, double accel)
    : distance_(distance), entry_(entry), exit_(exit), accel_(accel) {
    const double reach = accel * distance;
    const double half_gain = 0.5 * (exit - entry) * (exit + entry);  // change of velocity2
    if (std::fabs(half_gain) > reach) {
        clamp_exit_velocity();
        return;
    }
    const double peak_squared = 0.5 * (entry * entry + exit * exit) + reach;
    if (peak_squared > velocity * velocity) {
        cruise_at(std::max({velocity, entry, exit}));
        return;
    }
    peak_ = std::max({std::sqrt(peak_squared), entry, exit});
    if (!(peak_ > 0)) return;
    // durations from lengths: differences of nearly equal velocities would lose their digits
    cruise_start_ = 0.5 * (reach + half_gain) / accel;
    cruise_from_ = 2 * cruise_start_ / (entry + peak_);
    cruise_until_ = cruise_from_;
    duration_ = cruise_from_ + 2 * (distance - cruise_start_) / (exit + peak_);
}

void TrapezoidalProfile::cruise_at(double velocity) {
    const double per_accel = 1 / accel_;
    const double up = (velocity - entry_) * per_accel;
    const double down = (velocity - exit_) * per_accel;
    peak_ = velocity;
    cruise_from_ = up;
    cruise_start_ = 0.5 * (entry_ + velocity) * up;
    cruise_until_ = up + std::max(0.0, (distance_ - cruise_start_ - 0.5 * (exit_ + velocity) * down) / velocity);
    duration_ = cruise_until_ + down;
}

void TrapezoidalProfile::clamp_exit_velocity() {
    const double change = 2 * accel_ * distance_;
    const bool up = exit_ > entry_;
    exit_ = std::sqrt(std::max(0.0, entry_ * entry_ + (up ? change : -change)));
    peak_ = std::max(entry_, exit_);
    duration_ = 2 * distance_ / (entry_ + exit_);
    if (up) {
        cruise_from_ = cruise_until_ = duration_;
        cruise_start_ = distance_;
    }
}

SCurveProfile::SCurveProfile(double distance, double velocity, double accel, double jerk) : distance_(distance) {
    if (!(distance > 0)) return;
    const double accel_squared = accel * accel;
    double rise = 0;            // s, phases 0 and 2
    double accel_duration = 0;  // s, phases 0 to 2
    double cruise = 0;
    peak_ = velocity;
    peak_accel_ = accel;
    if (velocity * jerk >= accel_squared) {
        rise = accel / jerk;
        accel_duration = rise + velocity / accel;
        if (distance >= velocity * accel_duration) {
            cruise = distance / velocity - accel_duration;
        } else if (distance * jerk >= 2 * accel * rise * accel) {
            // peak^2 + accel rise peak = accel distance
            const double b = accel * rise;
            peak_ = 2 * accel * distance / (b + std::sqrt(b * b + 4 * accel * distance));
            accel_duration = distance / peak_;
        } else {
            rise = cube_root(0.5 * distance / jerk);
            accel_duration = 2 * rise;
            peak_accel_ = jerk * rise;
            peak_ = peak_accel_ * rise;
        }
    } else {
        rise = std::sqrt(velocity / jerk);
        accel_duration = 2 * rise;
        if (distance >= velocity * accel_duration) {
            cruise = distance / velocity - accel_duration;
        } else {
            rise = cube_root(0.5 * distance / jerk);
            accel_duration = 2 * rise;
            peak_ = jerk * rise * rise;
        }
        peak_accel_ = jerk * rise;
    }
    cruise = std::max(cruise, 0.0);
    duration_ = 2 * accel_duration + cruise;

    const double velocity_0 = 0.5 * peak_accel_ * rise;  // at the end of phase 0
    ends_ = {rise, accel_duration - rise, accel_duration};
    const double sixth = jerk * (1.0 / 6);
    phases_[0] = {0, 0, 0, 0, sixth, jerk};
    phases_[1] = {rise, velocity_0 * rise * (1.0 / 3), velocity_0, 0.5 * peak_accel_, 0, 0};
    // phase 2 is stored backwards from its end, where the acceleration is 0
    phases_[2] = {accel_duration, 0.5 * peak_ * accel_duration, peak_, 0, -sixth, -jerk};
}

std::array<double, 7> SCurveProfile::phase_ends() const {
    return {ends_[0], ends_[1], ends_[2], duration_ - ends_[2], duration_ - ends_[1], duration_ - ends_[0], duration_};
}

}  // namespace motionrack::control
