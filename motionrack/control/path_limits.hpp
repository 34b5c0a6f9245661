// What the axes' limits mean along a path: the greatest speed and acceleration of a move, and the greatest speed at a
// joint.
#pragma once

#include <array>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// Directions closer than 0.01 degrees count as the same: no axis can notice, and rounded coordinates never agree
/// better.
inline constexpr double tangent_angle_rad = 1.7453292519943295e-4;

/// Are the two tangents closer than tangent_angle_rad? XYZ parts are unit vectors; ABC parts are compared by their own
/// size.
bool is_same_direction(const Point& in, const Point& out);

/// Per unit of path length and second.
struct AlongPathLimits {
    double speed = 0;  ///< the feed, or less where an axis or the pull of a curve asks for less
    double accel = 0;  ///< both ways, at every point of the path
    double jerk = 0;   ///< straight moves whose axes all have a jerk limit; else 0
};

/// The axes' limits, prepared so that a move costs a few products and one division.
class PathLimits {
  public:
    explicit PathLimits(const MachineLimits& limits);

    /// Limits along `path`, which is not PathShape::nothing.
    ///
    /// Lines and rotary moves: component * speed and component * acceleration stay within each axis' limits.
    ///
    /// Arcs: let a be the lesser acceleration of the plane's two axes. The acceleration towards the centre stays within
    /// 0.8 a and the one along the arc within 0.4 a; they are at right angles, so their sum is within 0.9 a in every
    /// direction. The axis along a helix and the rotary axes feel only the acceleration along the path.
    AlongPathLimits along(const Geometry& path, const Move& move) const;

    /// Square of the greatest speed at the joint of `before` and `after`, whose cruise speeds are `speed_before` and
    /// `speed_after`; `path` and `tolerance_mm` are those of the move before the joint.
    ///
    /// exact_stop: 0. exact_path: 0 if the direction changes (see tangent_angle_rad).
    /// continuous: the machine goes through the corner itself, so the velocity of each axis jumps; it stays within
    ///   - the jump the axis can take: |v (out - in)| <= start_speed;
    ///   - the tolerance (junction deviation): v^2 = a d s / (1 - s), s = sin(half the inner angle), d the tolerance,
    ///     a the acceleration the axes have along the change of direction;
    ///   - the mean acceleration from the middle of the one move to the middle of the next, so that a curve made
    ///     of many short lines is not taken faster than the same curve as an arc.
    /// 0 between moves of XYZ and of ABC alone, because their lengths are not of one kind.
    double max_junction_velocity2(const Geometry& before, double speed_before, const Geometry& after,
                                  double speed_after, PathControl path, double tolerance_mm) const;

    /// An axis that moves on `path` although the machine has none, or -1.
    int missing_axis(const Geometry& path) const;

  private:
    double max_corner_velocity2(const Point& in, const Point& out, double mean_length, double tolerance_mm) const;

    // 1 / limit, so that an axis that must not jump has a great number, and an axis without jerk limit -1
    std::array<double, axis_count> per_speed_;
    std::array<double, axis_count> per_accel_;
    std::array<double, axis_count> per_jerk_;
    std::array<double, axis_count> per_jump_;
    std::array<bool, axis_count> present_;
    bool any_jerk_ = false;
};

}  // namespace motionrack::control
