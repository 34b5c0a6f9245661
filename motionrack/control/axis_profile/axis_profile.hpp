// The quickest motion of one axis from any state to another, within a speed, an acceleration and a jerk.
//
//   acceleration                                    phases of constant jerk; any may last 0 s and is then left out
//      ___                                            0 2 4 6: jerk +j -j -j +j
//     /   \                                           1 5:     greatest acceleration
//  __/     \___________            __                 3:       cruise at the greatest speed
//   | 0| 1|2|    3     \          /                 or the same upside down. In front of them stand those that bring a
//                       \________/                  start that is outside the limits within them.
//                      | 4|  5  |6|
//
// Units: any length (mm, degrees, pulses) and seconds. The solution takes no memory and no C library functions beyond
// sqrt, and has the same bits on every compiler.
#pragma once

#include <array>
#include <motionrack/control/rest_profiles.hpp>
#include <optional>
#include <span>

namespace motionrack::control {

/// Where an axis is and how it moves.
struct KinematicState {
    double position = 0;
    double speed = 0;  ///< of either sign
    double accel = 0;  ///< of either sign
};

/// Greatest amounts, in both directions; all > 0 and finite.
struct KinematicLimits {
    double speed = 0;
    double accel = 0;
    double jerk = 0;
};

/// Positions over time, made by travel(), change_speed() and stop().
class AxisProfile {
  public:
    /// A cubic in the time since `zero`; it holds until `end`.
    struct Phase {
        double end;      ///< s from the start of the travel
        double zero;     ///< s from the start of the travel: the phase's begin, or its end where it is told backwards
        double seconds;  ///< how long it lasts, more exactly than `end` tells it; < 0 where it is told backwards
        double position, speed, accel;  ///< at `zero`
        double jerk;

        /// The state at `t`, s from the start of the travel, within the phase.
        ProfileSample at(double t) const {
            // the end of a long travel is known less exactly than the length of a phase: no reason to pass a limit
            double s = t - zero;
            s = seconds < 0 ? (s < seconds ? seconds : s > 0 ? 0 : s) : (s > seconds ? seconds : s < 0 ? 0 : s);
            return {position + s * (speed + s * (0.5 * accel + s * jerk * (1.0 / 6))),
                    speed + s * (accel + 0.5 * s * jerk), accel + s * jerk, jerk};
        }
    };
    static constexpr int max_phases = 9;

    AxisProfile() {}  // which leaves the phases as they are: clearing them would take a tenth of a travel's time

    double duration() const { return duration_; }           ///< s
    const KinematicState& start() const { return start_; }  ///< as it was given
    const KinematicState& target() const {
        return target_;
    }  ///< as it was given; after change_speed() with the place reached

    /// In order; those of 0 s are left out. At most 9.
    std::span<const Phase> phases() const { return {phases_.data(), static_cast<std::size_t>(count_)}; }

    /// The state at `t` s; up to 0 the start, from duration() on the target, exactly.
    ProfileSample sample(double t) const;

  private:
    friend class AxisProfileBuilder;
    std::array<Phase, max_phases> phases_;
    int count_ = 0;
    double duration_ = 0;
    KinematicState start_;
    KinematicState target_;
};

/// True if a motion can end so and go on within the limits: |accel| <= limits.accel and
/// |speed| + accel^2 / (2 limits.jerk) <= limits.speed, to 1e-10 of the limits. False for what is not finite.
bool is_feasible_end(double speed, double accel, const KinematicLimits& limits);

/// The quickest motion from `from` to `to`, its duration to 1e-8 of itself and of 1 s; speed and acceleration stay
/// within 1 + 1e-9 of the limits. `from` is any state of finite numbers. An acceleration outside the limits is brought
/// within first; then a speed that is outside, or cannot but get there, is, too, each as quickly as the jerk allows.
/// The quickest motion begins where the speed is within for good, so that a start that is too fast comes in slowing
/// down and may get slower than the limit. A target that the direct change of speed misses by no more than roundings of
/// the numbers is reached by it. Nothing if the motion cannot end so (see is_feasible_end), a number is not finite or a
/// limit is not > 0.
std::optional<AxisProfile> time_optimal_profile(const KinematicState& from, const KinematicState& to,
                                                const KinematicLimits& limits);

/// The quickest change to a speed and an acceleration, wherever that is. An acceleration outside the limits is brought
/// within first; a speed outside is left on the quickest way to the target. Nothing as for travel().
std::optional<AxisProfile> velocity_change_profile(const KinematicState& from, double speed, double accel,
                                                   const KinematicLimits& limits);

/// The quickest way to rest, wherever that is; as change_speed() to 0. Nothing if a number is not finite or a limit is
/// not > 0.
std::optional<AxisProfile> stop_profile(const KinematicState& from, const KinematicLimits& limits);

inline ProfileSample AxisProfile::sample(double t) const {
    if (!(t > 0)) return {start_.position, start_.speed, start_.accel, count_ > 0 ? phases_[0].jerk : 0};
    if (t >= duration_) return {target_.position, target_.speed, target_.accel, 0};
    const Phase* p = phases_.data();
    while (t >= p->end) ++p;
    return p->at(t);
}

}  // namespace motionrack::control
