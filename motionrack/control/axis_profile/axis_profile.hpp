// Time-optimal profile of one axis from any state to any state, within a velocity, an acceleration and a jerk.
//
//   acceleration                                    phases of constant jerk; any may last 0 s and is then omitted
//      ___                                            0 2 4 6: jerk +j -j -j +j
//     /   \                                           1 5:     maximum acceleration
//  __/     \___________            __                 3:       cruise at the maximum velocity
//   | 0| 1|2|    3     \          /                 or the same mirrored. Phases in front of them bring a start state
//                       \________/                  from outside the limits to within them.
//                      | 4|  5  |6|
//
// Units: any length (mm, degrees, pulses) and seconds. The solution allocates nothing and calls only sqrt of the C
// library, so it has the same bits on every compiler.
#pragma once

#include <array>
#include <motionrack/control/rest_profiles.hpp>
#include <optional>
#include <span>

namespace motionrack::control {

/// Position, velocity and acceleration of an axis.
struct KinematicState {
    double position = 0;
    double velocity = 0;  ///< per second, signed
    double accel = 0;     ///< per second squared, signed
};

/// Limits of velocity, acceleration and jerk, for both directions; all > 0 and finite.
struct KinematicLimits {
    double velocity = 0;
    double accel = 0;
    double jerk = 0;
};

/// Position over time, made by time_optimal_profile(), velocity_change_profile() and stop_profile().
class AxisProfile {
  public:
    /// A cubic in the time since `zero`, valid until `end`.
    struct CubicPhase {
        double end;  ///< s from the start of the profile
        double
            zero;  ///< s from the start of the profile: start of the phase, or its end if the phase is stored backwards
        double seconds;                    ///< duration, more exact than `end`; < 0 if the phase is stored backwards
        double position, velocity, accel;  ///< at `zero`
        double jerk;

        /// Returns the state at `t`, s from the start of the profile, within the phase.
        ProfileSample at(double t) const {
            // `end` of a long profile is less exact than the duration of a phase, and must not cause a limit violation
            double s = t - zero;
            s = seconds < 0 ? (s < seconds ? seconds : s > 0 ? 0 : s) : (s > seconds ? seconds : s < 0 ? 0 : s);
            return {position + s * (velocity + s * (0.5 * accel + s * jerk * (1.0 / 6))),
                    velocity + s * (accel + 0.5 * s * jerk), accel + s * jerk, jerk};
        }
    };
    static constexpr int max_phases = 9;

    AxisProfile() {}  // leaves the phases uninitialised: clearing them would take a tenth of the time of a solution

    double duration() const { return duration_; }           ///< s
    const KinematicState& start() const { return start_; }  ///< start state, as given
    const KinematicState& target() const {
        return target_;
    }  ///< target state, as given; after velocity_change_profile() with the position reached

    /// Returns the phases in order, without those of 0 s. At most 9.
    std::span<const CubicPhase> phases() const { return {phases_.data(), static_cast<std::size_t>(count_)}; }

    /// Returns the state at `t` s; up to 0 the start, from duration() on exactly the target.
    ProfileSample sample(double t) const;

  private:
    friend class AxisProfileBuilder;
    std::array<CubicPhase, max_phases> phases_;
    int count_ = 0;
    double duration_ = 0;
    KinematicState start_;
    KinematicState target_;
};

/// Returns true if a motion can end in this state and continue within the limits. This requires |accel| <= limits.accel
/// and |velocity| + accel^2 / (2 limits.jerk) <= limits.velocity, to 1e-10 of the limits. Returns false for numbers
/// that are not finite.
bool is_feasible_end(double velocity, double accel, const KinematicLimits& limits);

/// Computes the time-optimal profile from `from` to `to`; its duration is exact to 1e-8 of itself and of 1 s. Velocity
/// and acceleration stay within 1 + 1e-9 of the limits. `from` is any state of finite numbers. An acceleration outside
/// the limits is brought within them first. Then a velocity that is outside, or cannot avoid leaving, is brought
/// within, as fast as the jerk allows. The time-optimal part starts when the velocity stays within the limits; it may
/// overshoot below the velocity limit while it decelerates into it. Reaches a target that the direct velocity change
/// misses only by rounding. Returns nothing if the end state is not feasible (see is_feasible_end), a number is not
/// finite or a limit is not > 0.
std::optional<AxisProfile> time_optimal_profile(const KinematicState& from, const KinematicState& to,
                                                const KinematicLimits& limits);

/// Computes the fastest change to a velocity and an acceleration; the end position is free. An acceleration outside the
/// limits is brought within them first; a velocity outside is left on the way to the target. Returns nothing as
/// time_optimal_profile().
std::optional<AxisProfile> velocity_change_profile(const KinematicState& from, double velocity, double accel,
                                                   const KinematicLimits& limits);

/// Computes the fastest stop; the end position is free; as velocity_change_profile() to 0. Returns nothing if a number
/// is not finite or a limit is not > 0.
std::optional<AxisProfile> stop_profile(const KinematicState& from, const KinematicLimits& limits);

inline ProfileSample AxisProfile::sample(double t) const {
    if (!(t > 0)) return {start_.position, start_.velocity, start_.accel, count_ > 0 ? phases_[0].jerk : 0};
    if (t >= duration_) return {target_.position, target_.velocity, target_.accel, 0};
    const CubicPhase* p = phases_.data();
    while (t >= p->end) ++p;
    return p->at(t);
}

}  // namespace motionrack::control
