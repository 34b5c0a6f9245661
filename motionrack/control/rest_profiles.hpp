// Velocity profiles of one axis: trapezoidal between any two velocities, and jerk-limited from standstill to
// standstill.
//
//   velocity  trapezoid                     double-S (7 phases)
//             ____________                      ____________
//            /            \                   ,'            `.          phases 0 2 4 6: jerk +j -j -j +j
//           /              \                 /                \         phases 1 5:     acceleration constant
//   entry  /                \  exit        ,'                  `.       phase  3:       cruise
//         |  0  |    1   |  2 |            | 0|1|2|    3    |4|5|6|     any phase may last 0 s
//
// Units: any length (mm, degrees, pulses) and seconds. Plans take no loops and no C library functions beyond sqrt.
#pragma once

#include <array>
#include <cstddef>

namespace motionrack::control {

/// Kinematic state at an instant of a profile.
struct ProfileSample {
    double position;  ///< from the start of the profile
    double velocity;
    double accel;
    double jerk;  ///< in the current phase; 0 for trapezoids
};

/// The time-optimal profile over a distance between two velocities, within a velocity limit and an acceleration limit.
class TrapezoidalProfile {
  public:
    TrapezoidalProfile() = default;

    /// Computes the profile from standstill to standstill. Requires `distance` >= 0, `velocity` > 0, `accel` > 0, all
    /// finite.
    TrapezoidalProfile(double distance, double velocity, double accel);

    /// Computes the profile from `entry` to `exit`, both 0 .. `velocity`. If the distance is too short for this change
    /// of velocity, clamps the exit velocity to the nearest reachable one; see exit().
    TrapezoidalProfile(double distance, double entry, double exit, double velocity, double accel);

    double distance() const { return distance_; }  ///< length
    double duration() const { return duration_; }  ///< s
    double entry() const { return entry_; }        ///< velocity at the start
    double exit() const { return exit_; }          ///< velocity at the end
    double peak() const { return peak_; }          ///< peak velocity

    /// Returns the ends of the phases (acceleration, cruise, deceleration), s.
    std::array<double, 3> phase_ends() const { return {cruise_from_, cruise_until_, duration_}; }

    /// Returns the state at `t` s; before 0 the start, from duration() on the end with exactly the whole distance.
    ProfileSample sample(double t) const;

  private:
    void cruise_at(double velocity);
    void clamp_exit_velocity();

    double distance_ = 0;
    double duration_ = 0;
    double entry_ = 0;
    double exit_ = 0;
    double accel_ = 0;
    double peak_ = 0;
    double cruise_from_ = 0;
    double cruise_until_ = 0;
    double cruise_start_ = 0;  ///< position at cruise_from_
};

/// The time-optimal profile from standstill to standstill, within limits of velocity, acceleration and jerk. It is
/// symmetric, so only the first half is stored: three phases and half of the cruise.
class SCurveProfile {
  public:
    SCurveProfile() = default;

    /// Computes the profile. Requires `distance` >= 0, the others > 0, and all finite.
    SCurveProfile(double distance, double velocity, double accel, double jerk);

    double distance() const { return distance_; }      ///< length
    double duration() const { return duration_; }      ///< s
    double peak() const { return peak_; }              ///< peak velocity
    double peak_accel() const { return peak_accel_; }  ///< peak acceleration

    /// Returns the ends of the seven phases, s.
    std::array<double, 7> phase_ends() const;

    /// Returns the state at `t` s; before 0 the start, from duration() on the end with exactly the whole distance.
    ProfileSample sample(double t) const;

  private:
    /// A cubic in the time since the zero of the phase.
    struct CubicPhase {
        double zero = 0;
        double position = 0;
        double velocity = 0;
        double half_accel = 0;
        double sixth_jerk = 0;
        double jerk = 0;
    };

    double distance_ = 0;
    double duration_ = 0;
    double peak_ = 0;
    double peak_accel_ = 0;
    std::array<double, 3> ends_ = {};  ///< end times of phases 0, 1, 2
    std::array<CubicPhase, 3> phases_ = {};
};

/// Returns the cube root of x >= 0, to a relative error of 7e-16 and with the same bits on every platform.
double cube_root(double x);

inline ProfileSample TrapezoidalProfile::sample(double t) const {
    if (t < cruise_from_) {
        if (t < 0) t = 0;
        return {t * (entry_ + 0.5 * accel_ * t), entry_ + accel_ * t, accel_, 0};
    }
    if (t < cruise_until_) return {cruise_start_ + peak_ * (t - cruise_from_), peak_, 0, 0};
    if (t < duration_) {
        const double left = duration_ - t;
        return {distance_ - left * (exit_ + 0.5 * accel_ * left), exit_ + accel_ * left, -accel_, 0};
    }
    return {distance_, exit_, 0, 0};
}

inline ProfileSample SCurveProfile::sample(double t) const {
    const double left = duration_ - t;
    if (!(left > 0)) return {distance_, 0, 0, 0};
    if (t < 0) t = 0;
    const bool first_half = t <= left;
    const double u = first_half ? t : left;
    if (u >= ends_[2]) return {0.5 * distance_ + peak_ * (t - 0.5 * duration_), peak_, 0, 0};
    const CubicPhase& p = phases_[static_cast<std::size_t>((u >= ends_[0]) + (u >= ends_[1]))];
    const double s = u - p.zero;
    const double position = p.position + s * (p.velocity + s * (p.half_accel + s * p.sixth_jerk));
    const double velocity = p.velocity + s * (2 * p.half_accel + 3 * p.sixth_jerk * s);
    const double accel = 2 * p.half_accel + p.jerk * s;
    return {first_half ? position : distance_ - position, velocity, first_half ? accel : -accel, p.jerk};
}

}  // namespace motionrack::control
