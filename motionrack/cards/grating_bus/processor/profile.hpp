// Where an axis is to be, as closed forms of time: a scan to and fro, and a staircase of steps; acceleration and jerk
// are limited.
//
//   scan                                             steps
//   place ^      to .--.            .-- turn         place ^            .------
//         |      /|    |\          /                       |     .-----'        each `every_s`: the move, then rest
//         |     / |    | \        /                        |----'
//         |  _.'  from |  `.____.'                         +------------------> time
//         +-----------------------------> time
//           start  constant speed between from and to
//
//   accel ^   .------.        one change of speed: jerk up, the greatest acceleration, jerk down;
//         |__/        \____   only the jerks if the change is small
#pragma once

#include <cstdint>

namespace motionrack::grating_bus {

/// What is wanted at one instant; nm and seconds.
struct Setpoint {
    double position_nm = 0;
    double speed_nm_s = 0;
    double accel_nm_s2 = 0;
};

/// The same, geared: a stage that goes `factor` times as far.
constexpr Setpoint geared(const Setpoint& s, double factor) {
    return {s.position_nm * factor, s.speed_nm_s * factor, s.accel_nm_s2 * factor};
}

/// Limits of a profile, all more than 0.
struct MotionLimits {
    double speed_nm_s = 1e8;   ///< 100 mm/s
    double accel_nm_s2 = 5e9;  ///< 5 m/s2
    double jerk_nm_s3 = 1e12;  ///< 1000 m/s3
};

/// A change of speed with limited acceleration and jerk.
class SpeedChange {
  public:
    SpeedChange() = default;
    SpeedChange(double from_nm_s, double to_nm_s, const MotionLimits& limits);
    /// Position from its beginning, `seconds` (0 .. duration()) after it.
    Setpoint at(double seconds) const;
    double duration() const { return 2 * jerk_s_ + accel_s_; }
    /// How far it goes.
    double way() const { return (from_ + to_) / 2 * duration(); }

  private:
    double from_ = 0;
    double to_ = 0;
    double jerk_ = 0;     // signed
    double jerk_s_ = 0;   // of one jerk
    double accel_s_ = 0;  // with the greatest acceleration
};

/// Stands.
struct HoldProfile {
    double place_nm = 0;
    Setpoint at(double) const { return {place_nm, 0, 0}; }
};

/// From standstill to a constant speed between two places, and to and fro between them with turns outside.
class ScanProfile {
  public:
    /// `from_nm` < `to_nm`.
    ScanProfile(double from_nm, double to_nm, const MotionLimits& limits);
    Setpoint at(double seconds) const;
    /// Where it stands before.
    double start_nm() const { return from_ - start_.way(); }
    /// Whether the speed is constant at `seconds`, to or fro.
    bool scanning(double seconds) const;
    /// From reaching `from_nm` to reaching it again in the same direction.
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

/// `steps` steps up, each `every_s`, then as many down, and so on.
class StepProfile {
  public:
    /// `step_nm` not 0; `steps` > 0; `every_s` at least move_s().
    StepProfile(double start_nm, double step_nm, int steps, double every_s, const MotionLimits& limits);
    Setpoint at(double seconds) const;
    /// How long one move takes.
    double move_s() const { return 2 * up_.duration() + line_s_; }
    /// Since the last move ended; negative during a move.
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

/// What a loop needs at a frame of `seconds`: place and speed of that instant, the acceleration of the middle of the
/// period that follows, which is the one that its voltage will act on.
template <class Profile>
Setpoint wanted_at(const Profile& profile, double seconds, double period_s) {
    Setpoint out = profile.at(seconds);
    out.accel_nm_s2 = profile.at(seconds + period_s / 2).accel_nm_s2;
    return out;
}

}  // namespace motionrack::grating_bus
