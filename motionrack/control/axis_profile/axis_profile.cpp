// A profile is solved in units of its limits (jerk 1, acceleration 1) and stored in user units. It is stored forwards
// from the start up to the cruise, and backwards from the target behind it. Both ends are exact; rounding errors meet
// in the middle.

#include <algorithm>
#include <cmath>
#include <motionrack/control/axis_profile/axis_profile.hpp>
#include <motionrack/control/axis_profile/double_s_solver.hpp>

namespace motionrack::control {

namespace {

constexpr double to_roundings = 1 + 1e-10;

/// Factors from user units to the scaled units, in which jerk and acceleration have the limit 1.
struct Scale {
    explicit Scale(const KinematicLimits& limits)
        : accel(1 / limits.accel),
          seconds(limits.accel / limits.jerk),
          velocity(limits.jerk * accel * accel),
          position(velocity * limits.jerk * accel),
          top(limits.velocity * velocity) {}
    double accel;
    double seconds;  ///< user seconds in one scaled second: the factor back
    double velocity;
    double position;
    double top;
};

/// Returns the velocity at which the acceleration has been brought to 0 at full jerk, in scaled units.
double velocity_at_last(double velocity, double accel) {
    return velocity + 0.5 * accel * std::fabs(accel);
}

bool ends_within(double velocity, double accel, double top) {
    return std::fabs(accel) <= to_roundings && std::fabs(velocity) + 0.5 * accel * accel <= top * to_roundings;
}

bool usable(const KinematicLimits& limits) {
    const auto amount = [](double x) { return x > 0 && std::isfinite(x); };
    return amount(limits.velocity) && amount(limits.accel) && amount(limits.jerk);
}

bool finite(const KinematicState& s) {
    return std::isfinite(s.position) && std::isfinite(s.velocity) && std::isfinite(s.accel);
}

}  // namespace

/// Converts scaled phases to user units.
class AxisProfileBuilder {
  public:
    AxisProfileBuilder(AxisProfile& out, const KinematicState& from, const KinematicLimits& limits, const Scale& scale)
        : out_(out), at_(from), limits_(limits), scale_(scale) {
        out_.start_ = from;
        velocity_ = from.velocity * scale.velocity;
        accel_ = from.accel * scale.accel;
    }

    double distance() const { return distance_; }

    /// Returns the conditions from the current state to a velocity in user units, the other values scaled.
    BoundaryConditions course_to(double velocity, double accel, double distance) const {
        const double end = velocity * scale_.velocity;
        const double change = time_ == 0 ? (velocity - at_.velocity) * scale_.velocity : end - velocity_;
        return {velocity_, accel_, end, accel, distance, change};
    }

    void bring_accel_within() {
        if (std::fabs(accel_) <= 1) return;
        const double sign = accel_ > 0 ? 1 : -1;
        ramp(-sign, std::fabs(accel_) - 1);
        accel_ = sign;
    }

    /// Returns the maximum velocity for the following phases, which the start may exceed by rounding.
    double bring_velocity_within() {
        const double last = velocity_at_last(velocity_, accel_);
        const double max_velocity = std::max(std::fabs(last), std::fabs(velocity_));
        if (max_velocity <= scale_.top * to_roundings) return std::max(max_velocity, scale_.top);
        if (std::fabs(last) > scale_.top) {
            brake(last > 0 ? 1 : -1);
        } else {
            brake(velocity_ > 0 ? 1 : -1);
        }
        return scale_.top;
    }

    /// Adds the phases, each with jerk of one sign, in order of time; stores the first four forwards.
    void add(const TimeOptimalSolution& course, double top) {
        const DoubleSPhases& p = course.phases;
        const double side = course.mirrored ? -1 : 1;
        const double sign = course.backwards ? -side : side;
        if (course.backwards) {
            forward(-side, p.back);
            hold(-side, p.low);
            forward(side, p.sink);
        } else {
            forward(side, p.rise);
            hold(side, p.hold);
            forward(-side, p.fall);
        }
        if (p.cruise > 0) {
            at_.velocity = sign * (top > scale_.top ? top / scale_.velocity : limits_.velocity);
            at_.accel = 0;
            forward(0, p.cruise);
        }
        if (course.backwards) {
            tail_ = {Part{side, p.fall}, Part{0, p.hold, side}, Part{-side, p.rise}};
        } else {
            tail_ = {Part{-side, p.sink}, Part{0, p.low, -side}, Part{side, p.back}};
        }
    }

    /// Stores the last three phases backwards from the target.
    void end_at(const KinematicState& target) {
        double end[4] = {time_};
        for (int k = 0; k < 3; ++k) end[k + 1] = end[k] + tail_[k].seconds * scale_.seconds;
        int last = out_.count_;
        for (int k = 0; k < 3; ++k) last += end[k + 1] > end[k];
        out_.count_ = last;
        KinematicState at = target;
        for (int k = 2; k >= 0; --k) {
            if (!(end[k + 1] > end[k])) continue;
            const Part& part = tail_[k];
            if (part.jerk == 0) at.accel = part.hold * limits_.accel;
            const double jerk = part.jerk * limits_.jerk, seconds = part.seconds * scale_.seconds;
            out_.phases_[static_cast<std::size_t>(--last)] = {end[k + 1],  end[k + 1], -seconds, at.position,
                                                              at.velocity, at.accel,   jerk};
            at = after(at, jerk, -seconds);
        }
        out_.duration_ = end[3];
        out_.target_ = target;
    }

    /// Adds a direct velocity change, stored forwards.
    void change(const DirectVelocityChange& change, double velocity, double accel) {
        const double side = change.mirrored ? -1 : 1;
        forward(side, change.rise);
        hold(side, change.hold);
        forward(-side, change.fall);
        out_.duration_ = time_;
        out_.target_ = {at_.position, velocity, accel};
    }

  private:
    struct Part {
        double jerk, seconds, hold = 0;
    };

    static KinematicState after(const KinematicState& s, double jerk, double t) {
        return {s.position + t * (s.velocity + t * (0.5 * s.accel + t * jerk * (1.0 / 6))),
                s.velocity + t * (s.accel + 0.5 * t * jerk), s.accel + t * jerk};
    }

    /// Adds a phase, stored forwards. `sign`: sign of the jerk; `scaled`: its duration, scaled s.
    void forward(double sign, double scaled) {
        if (!(scaled > 0)) return;
        const double seconds = scaled * scale_.seconds;
        const double jerk = sign * limits_.jerk;
        AxisProfile::CubicPhase* last =
            out_.count_ > 0 ? &out_.phases_[static_cast<std::size_t>(out_.count_ - 1)] : nullptr;
        const double zero = time_;
        time_ += seconds;
        if (last && sign != 0 && last->jerk == jerk && goes_on_) {
            last->end = time_;
            last->seconds += seconds;
        } else if (time_ > zero) {
            out_.phases_[static_cast<std::size_t>(out_.count_++)] = {time_,        zero,      seconds, at_.position,
                                                                     at_.velocity, at_.accel, jerk};
        }
        goes_on_ = goes_on_ || time_ > zero;
        at_ = after(at_, jerk, seconds);
    }

    void hold(double sign, double scaled) {
        if (!(scaled > 0)) return;
        at_.accel = sign * limits_.accel;
        forward(0, scaled);
    }

    /// Adds a phase before the solution; tracks it in scaled units as well, for the remaining distance.
    void ramp(double sign, double t) {
        distance_ += t * (velocity_ + t * (0.5 * accel_ + t * sign * (1.0 / 6)));
        velocity_ += t * (accel_ + 0.5 * t * sign);
        accel_ += t * sign;
        forward(sign, t);
    }

    void keep(double t) {
        if (!(t > 0)) return;
        distance_ += t * (velocity_ + 0.5 * t * accel_);
        velocity_ += t * accel_;
        hold(accel_ > 0 ? 1 : -1, t);
    }

    /// Decelerates from above the maximum velocity (side 1; -1: below minus the maximum) to it, with an acceleration
    /// that keeps the velocity above minus the maximum.
    void brake(double side) {
        const double top = scale_.top;
        const double over = side * velocity_ - top, accel = side * accel_;
        const double steepest = -std::min(1.0, 2 * std::sqrt(top));
        const double at_top = -std::sqrt(std::max(0.0, accel * accel + 2 * over));
        if (at_top >= steepest) {
            ramp(-side, std::max(0.0, accel - at_top));
            accel_ = side * at_top;
        } else {
            const DirectVelocityChange change =
                direct_velocity_change({side * velocity_, accel, top, steepest, 0, -over});
            ramp(-side, change.rise);
            if (change.hold > 0) accel_ = -side;
            keep(change.hold);
            ramp(side, change.fall);
            accel_ = side * steepest;
        }
        velocity_ = side * top;
        // continue exactly at the limit: far outside, rounding errors are large relative to the limits
        at_.velocity = side * limits_.velocity;
        at_.accel = accel_ * limits_.accel;
        goes_on_ = false;
    }

    AxisProfile& out_;
    KinematicState at_;
    const KinematicLimits& limits_;
    const Scale& scale_;
    double time_ = 0;
    bool goes_on_ = true;                     ///< at_ is exactly the end of the last phase
    double velocity_, accel_, distance_ = 0;  ///< scaled
    std::array<Part, 3> tail_ = {};
};

bool is_feasible_end(double velocity, double accel, const KinematicLimits& limits) {
    const Scale scale(limits);
    return usable(limits) && ends_within(velocity * scale.velocity, accel * scale.accel, scale.top);
}

std::optional<AxisProfile> time_optimal_profile(const KinematicState& from, const KinematicState& to,
                                                const KinematicLimits& limits) {
    const Scale scale(limits);
    const double end_velocity = to.velocity * scale.velocity;
    const double end_accel = std::clamp(to.accel * scale.accel, -1.0, 1.0);
    if (!usable(limits) || !finite(from) || !finite(to)) return std::nullopt;
    if (!ends_within(end_velocity, to.accel * scale.accel, scale.top)) return std::nullopt;
    std::optional<AxisProfile> out(std::in_place);
    AxisProfileBuilder builder(*out, from, limits, scale);
    builder.bring_accel_within();
    double top = builder.bring_velocity_within();
    top = std::max(top, std::fabs(end_velocity) + 0.5 * end_accel * end_accel);
    const double distance = (to.position - from.position) * scale.position - builder.distance();
    const double slack = 4.5e-16 * (std::fabs(from.position) + std::fabs(to.position)) * scale.position;
    builder.add(solve_time_optimal(builder.course_to(to.velocity, end_accel, distance), top, slack), top);
    builder.end_at(to);
    return out;
}

std::optional<AxisProfile> velocity_change_profile(const KinematicState& from, double velocity, double accel,
                                                   const KinematicLimits& limits) {
    const Scale scale(limits);
    const double end_velocity = velocity * scale.velocity, end_accel = accel * scale.accel;
    if (!usable(limits) || !finite(from) || !ends_within(end_velocity, end_accel, scale.top)) return std::nullopt;
    std::optional<AxisProfile> out(std::in_place);
    AxisProfileBuilder builder(*out, from, limits, scale);
    builder.bring_accel_within();
    builder.change(direct_velocity_change(builder.course_to(velocity, std::clamp(end_accel, -1.0, 1.0), 0)), velocity,
                   accel);
    return out;
}

std::optional<AxisProfile> stop_profile(const KinematicState& from, const KinematicLimits& limits) {
    return velocity_change_profile(from, 0, 0, limits);
}

}  // namespace motionrack::control
