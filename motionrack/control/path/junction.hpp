// Joints of a path: driven through on a rounded path, or with a stop at their point? What each costs, leg by leg.
//
//   speed  top ───────╮╱▔▔▔▔▔▔╲          a leg is a move between its two joints; where one is passed its half of the
//                     │        ╲___      turn is driven at the joint's speed, and the rest of the leg is left for
//              half ──┴─ rest ──┴─ half  changing it
//
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// The greatest speed on a curvature takes so much of an axis' acceleration across the path and of its jerk; the rest
/// changes the speed.
inline constexpr double max_curvature_share = 0.8;

/// A move, and what the axes can do along it; mm or degrees, and s.
struct LegLimits {
    double length = 0;
    double speed = 0, accel = 0, jerk = 0;
};

struct Junction {
    bool can_stop = true;
    bool can_pass = false;
    double speed = 0;              ///< through its turn, by what the axes can do
    double half_blend_length = 0;  ///< of the way over which the turn is spread, on either side
    double gain = 0;  ///< s that a stop wins because the next move begins before the one before it has ended

    bool is_choice() const { return can_stop && can_pass; }
};

/// s from one speed to another that is `more`, without acceleration at both.
double ramp_duration_s(double more, const LegLimits& leg);

/// An axis without a limit of its jerk gets one with which it reaches its acceleration in this time.
inline constexpr double default_jerk_time_s = 0.002;
inline double effective_jerk(const AxisLimits& axis) {
    return axis.max_jerk > 0 ? axis.max_jerk : axis.max_accel / default_jerk_time_s;
}

/// What the axes can do along `tangent`, or over a turn: the least of limit / |tangent|.
double max_velocity_along(const Point& tangent, const MachineLimits& limits);
double max_accel_along(const Point& tangent, const MachineLimits& limits);
double max_jerk_along(const Point& tangent, const MachineLimits& limits);

/// A turn from one tangent to another that is spread over `width`, between these legs. What a stop wins is not told.
Junction junction_between(const LegLimits& before, const LegLimits& after, const Point& in, const Point& out,
                          double width, const MachineLimits& limits);

/// s; a joint that is stopped at is left with its point. Very long where the leg has no room for it.
double leg_duration_s(const LegLimits& leg, const Junction& begin, bool stops_at_begin, const Junction& end,
                      bool stops_at_end);

}  // namespace motionrack::control
