// Limits of the axes expressed along a path: maximum velocity and acceleration of a move, and the junction velocity.
#pragma once

#include <array>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// Directions that differ by less than 0.01 degrees count as equal: no axis is affected, and rounded coordinates are
/// not more exact.
inline constexpr double tangent_angle_rad = 1.7453292519943295e-4;

/// Returns true if the tangents differ by less than tangent_angle_rad. XYZ parts are unit vectors; ABC parts are
/// compared relative to their own size.
bool is_same_direction(const Point& in, const Point& out);

/// Limits along a path, per unit of its length and second.
struct AlongPathLimits {
    double velocity = 0;  ///< the feed rate, or less where an axis or the centripetal acceleration requires it
    double accel = 0;     ///< for acceleration and deceleration, at every point of the path
    double jerk = 0;      ///< for straight moves whose axes all have a jerk limit; otherwise 0: no limit
};

/// The axis limits, prepared so that a move costs a few products and one division.
class PathLimits {
  public:
    explicit PathLimits(const MachineLimits& limits);

    /// Returns the limits along `path`, which is not PathShape::nothing.
    ///
    /// Lines and rotary moves: component * velocity and component * acceleration stay within each axis' limits.
    ///
    /// Arcs: let a be the lower acceleration limit of the plane's two axes. The centripetal acceleration stays within
    /// 0.8 a and the tangential one within 0.4 a. They are at right angles, so their sum is within 0.9 a in every
    /// direction. The helix axis and the rotary axes are subject to the tangential acceleration only.
    AlongPathLimits along(const Geometry& path, const Move& move) const;

    /// Returns the square of the junction velocity between `before` and `after`, whose cruise velocities are
    /// `velocity_before` and `velocity_after`. `path` and `tolerance_mm` belong to the move before the junction.
    ///
    /// exact_stop: 0. exact_path: 0 if the direction changes (see tangent_angle_rad).
    /// continuous: the machine passes the corner itself, so the velocity of each axis has a step. It stays within
    ///   - the velocity step limit of the axis: |v (out - in)| <= max_velocity_step;
    ///   - the tolerance (junction deviation): v^2 = a d s / (1 - s), s = sin(half the inner angle), d the tolerance,
    ///     a the acceleration that the axes have along the change of direction;
    ///   - the mean acceleration from the middle of one move to the middle of the next, so that a curve made of many
    ///     short lines is not faster than the same curve as an arc.
    /// 0 between moves of XYZ and moves of ABC only, because their lengths have different units.
    double max_junction_velocity2(const Geometry& before, double velocity_before, const Geometry& after,
                                  double velocity_after, PathControl path, double tolerance_mm) const;

    /// Returns an axis that moves on `path` but is missing on the machine, or -1.
    int missing_axis(const Geometry& path) const;

  private:
    double max_corner_velocity2(const Point& in, const Point& out, double mean_length, double tolerance_mm) const;

    // 1 / limit: large for an axis without a velocity step, -1 for an axis without a jerk limit
    std::array<double, axis_count> per_velocity_;
    std::array<double, axis_count> per_accel_;
    std::array<double, axis_count> per_jerk_;
    std::array<double, axis_count> per_jump_;
    std::array<bool, axis_count> present_;
    bool any_jerk_ = false;
};

}  // namespace motionrack::control
