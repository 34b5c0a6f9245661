// Junctions of a path: passed on a blend, or with a stop. Cost of both, leg by leg.
//
//   velocity  top ───╮╱▔▔▔▔▔▔╲          a leg is a move between its two junctions; where one is passed, its half of
//                    │        ╲___      the blend is driven at the junction velocity, and the rest of the leg is left
//             half ──┴─ rest ──┴─ half  for changing the velocity
//
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// Share of an axis' lateral acceleration and jerk that the maximum velocity on a curve uses; the rest changes the
/// velocity.
inline constexpr double max_curvature_share = 0.8;

/// A move and the limits of the axes along it; mm or degrees, and s.
struct LegLimits {
    double length = 0;
    double velocity = 0, accel = 0, jerk = 0;
};

struct Junction {
    bool can_stop = true;
    bool can_pass = false;
    double velocity = 0;           ///< junction velocity that the axes allow
    double half_blend_length = 0;  ///< half of the blend length, mm or degrees
    double gain = 0;  ///< time gained by a stop because the next move starts before the previous one ends, s

    bool is_choice() const { return can_stop && can_pass; }
};

/// Returns the duration of a velocity change by `more`, with zero acceleration at both ends, s.
double ramp_duration_s(double more, const LegLimits& leg);

/// An axis without a jerk limit gets one with which it reaches its acceleration in this time.
inline constexpr double default_jerk_time_s = 0.002;
inline double effective_jerk(const AxisLimits& axis) {
    return axis.max_jerk > 0 ? axis.max_jerk : axis.max_accel / default_jerk_time_s;
}

/// Return the highest velocity, acceleration and jerk along a path with this tangent: the minimum over the axes of
/// limit / |tangent|. For a blend, `tangent` is the change that it makes.
double max_velocity_along(const Point& tangent, const MachineLimits& limits);
double max_accel_along(const Point& tangent, const MachineLimits& limits);
double max_jerk_along(const Point& tangent, const MachineLimits& limits);

/// Computes a junction whose blend has the length `width`, between these legs; does not set the gain of a stop.
Junction junction_between(const LegLimits& before, const LegLimits& after, const Point& in, const Point& out,
                          double width, const MachineLimits& limits);

/// Returns the duration of a leg, s; a stop is at the junction point itself. Very long if the leg is too short.
double leg_duration_s(const LegLimits& leg, const Junction& begin, bool stops_at_begin, const Junction& end,
                      bool stops_at_end);

}  // namespace motionrack::control
