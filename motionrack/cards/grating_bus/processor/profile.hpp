// Commanded position of an axis in closed form: a scan to and fro, and a staircase of steps, with limited acceleration
// and jerk.
//
//   scan                                             steps
//   position ^   to .--.            .-- turn         position ^         .------
//         |      /|    |\          /                       |     .-----'        each `every_s`: a move, then standstill
//         |     / |    | \        /                        |----'
//         |  _.'  from |  `.____.'                         +------------------> time
//         +-----------------------------> time
//           start  constant velocity between from and to
//
//   accel ^   .------.        one velocity change: jerk up, maximum acceleration, jerk down;
//         |__/        \____   only the jerks if the change is small
#pragma once

#include <cstdint>

namespace motionrack::grating_bus {

/// Commanded motion at one instant, in nm and s.
struct Setpoint {
    double position_nm = 0;
    double speed_nm_s = 0;
    double accel_nm_s2 = 0;
};

/// Returns the motion scaled by `factor`, for a geared stage.
constexpr Setpoint geared(const Setpoint& s, double factor) {
    return {s.position_nm * factor, s.speed_nm_s * factor, s.accel_nm_s2 * factor};
}

/// Limits of a profile, all > 0.
struct MotionLimits {
    double speed_nm_s = 1e8;   ///< 100 mm/s
    double accel_nm_s2 = 5e9;  ///< 5 m/s2
    double jerk_nm_s3 = 1e12;  ///< 1000 m/s3
};

/// A velocity change with limited acceleration and jerk.
class SpeedChange {
  public:
    SpeedChange() = default;
    SpeedChange(double from_nm_s, double to_nm_s, const MotionLimits& limits);
    /// Returns the motion relative to the start of the change, `seconds` (0 .. duration()) after it.
    Setpoint at(double seconds) const;
    double duration() const { return 2 * jerk_s_ + accel_s_; }
    /// Returns the distance travelled during the change, nm.
    double distance() const { return (from_ + to_) / 2 * duration(); }

  private:
    double from_ = 0;
    double to_ = 0;
    double jerk_ = 0;     // signed
    double jerk_s_ = 0;   // duration of one jerk phase
    double accel_s_ = 0;  // duration at maximum acceleration
};

/// Profile of a standstill at one position.
struct HoldProfile {
    double place_nm = 0;
    Setpoint at(double) const { return {place_nm, 0, 0}; }
};

/// Accelerates from standstill to a constant velocity, then moves back and forth between two positions at that
/// velocity, with turns outside.
class ScanProfile {
  public:
    /// Requires `from_nm` < `to_nm`.
    ScanProfile(double from_nm, double to_nm, const MotionLimits& limits);
    Setpoint at(double seconds) const;
    /// Returns the position of the initial standstill.
    double start_nm() const { return from_ - start_.distance(); }
    /// Returns true if the velocity is constant at `seconds`, in either direction.
    bool scanning(double seconds) const;
    /// Returns the time from reaching `from_nm` to reaching it again in the same direction.
    double period_s() const { return 2 * (line_s_ + turn_.duration()); }
    double lead_s() const { return start_.duration(); }

  private:
    double phase(double seconds) const;

    double from_;
    double to_;
    double speed_;
    double line_s_;
    SpeedChange start_;
    SpeedChange turn_;
};

/// Moves up by `steps` steps, one each `every_s`, then down by the same number, repeatedly.
class StepProfile {
  public:
    /// Requires `step_nm` != 0, `steps` > 0, and `every_s` of at least move_s().
    StepProfile(double start_nm, double step_nm, int steps, double every_s, const MotionLimits& limits);
    Setpoint at(double seconds) const;
    /// Returns the duration of one move.
    double move_s() const { return 2 * up_.duration() + line_s_; }
    /// Returns the time since the last move ended; negative during a move.
    double settled_s(double seconds) const;

  private:
    double start_;
    double step_;
    int steps_;
    double every_;
    double line_s_ = 0;
    double speed_ = 0;
    SpeedChange up_;
    SpeedChange down_;
};

/// Returns the commanded values of a servo loop for a frame at `seconds`: position and velocity of that instant, and
/// the acceleration in the middle of the next period, in which the voltage acts.
template <class Profile>
Setpoint wanted_at(const Profile& profile, double seconds, double period_s) {
    Setpoint out = profile.at(seconds);
    out.accel_nm_s2 = profile.at(seconds + period_s / 2).accel_nm_s2;
    return out;
}

}  // namespace motionrack::grating_bus
