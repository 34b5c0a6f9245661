// What the axes' limits mean for the speed along a piece of a curve.
#pragma once

#include <array>
#include <cstddef>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/limit_interval.hpp>

namespace motionrack::control {

/// What an axis does on a piece, at most, as parts of its greatest acceleration or of its jerk: with speed v,
/// acceleration a and jerk j along the piece it has
///     p' v,   p' a + p'' v^2,   p' j + 3 p'' v a + p''' v^3.
struct AxisSegmentLimits {
    double tangent = 0, curvature = 0;  ///< |p'| and |p''|, of its acceleration
    double bend_up = 0, bend_down = 0;  ///< |p''| where it takes from speeding up, and where from slowing down
    double jerk_tangent = 0, jerk_bend = 0, jerk_twist = 0;  ///< |p'|, |p''| and |p'''|, of its jerk
};

struct SegmentLimits {
    SegmentLimits(const CubicSegment& piece, const MachineLimits& limits);

    std::array<AxisSegmentLimits, axis_count> axes;
    std::size_t count = 0;  ///< of the axes that move
    double speed =
        0;  ///< that keeps the feed, the axes' speeds, and leaves something of their accelerations beside the curvature
    double curvature_rate = 0;  ///< greatest jerk_twist
    bool straight = true;       ///< nothing depends on the speed

    /// And what the curvature alone takes of the axes' jerks is no more than this share of them.
    double max_velocity_for(double jerk_share) const;
    /// The share that leaves what these take, no less than max_curvature_share.
    double jerk_share_beside(double at_speed, double accel, double jerk) const;
    /// Up to this speed, no more than max_velocity_for(): acceleration and jerk along the piece with which no axis has
    /// more than its own.
    LimitInterval up_to(double top, double length) const;
    /// The greatest square of the speed `length` after `square`, with no more acceleration than is left there; and
    /// before it.
    double velocity2_after(double square, double length) const {
        return compute_reachable_velocities(square, length, &AxisSegmentLimits::bend_up);
    }
    double velocity2_before(double square, double length) const {
        return compute_reachable_velocities(square, length, &AxisSegmentLimits::bend_down);
    }

  private:
    double compute_reachable_velocities(double square, double length, double AxisSegmentLimits::*curvature) const;
};

}  // namespace motionrack::control
