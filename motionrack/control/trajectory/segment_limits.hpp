// Axis limits expressed along a segment of a curve.
#pragma once

#include <array>
#include <cstddef>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/limit_interval.hpp>

namespace motionrack::control {

/// Largest demands on an axis within a segment, as shares of its maximum acceleration or jerk. With velocity v,
/// acceleration a and jerk j along the segment the axis has
///     p' v,   p' a + p'' v^2,   p' j + 3 p'' v a + p''' v^3.
struct AxisSegmentLimits {
    double tangent = 0, curvature = 0;  ///< |p'| and |p''|, relative to its acceleration
    double curvature_up = 0,
           curvature_down = 0;  ///< |p''| where it reduces the available acceleration, and where the deceleration
    double jerk_tangent = 0, jerk_curvature = 0,
           jerk_curvature_rate = 0;  ///< |p'|, |p''| and |p'''|, relative to its jerk
};

struct SegmentLimits {
    SegmentLimits(const CubicSegment& piece, const MachineLimits& limits);

    std::array<AxisSegmentLimits, axis_count> axes;
    std::size_t count = 0;  ///< number of moving axes
    double velocity =
        0;  ///< within the feed rate and the axes' velocities; leaves some of their acceleration beside the curvature
    double curvature_rate = 0;  ///< largest jerk_curvature_rate of the axes
    bool straight = true;       ///< no curvature, so no limit depends on the velocity

    /// Returns the highest velocity up to `velocity` at which the curvature takes at most this share of the axes' jerk.
    double max_velocity_for(double jerk_share) const;
    /// Returns the share of the axes' jerk for the curvature that leaves enough for a motion with this velocity,
    /// acceleration and jerk; at least max_curvature_share.
    double jerk_share_beside(double at_velocity, double accel, double jerk) const;
    /// Returns the acceleration and jerk along the segment that keep every axis within its limits at any velocity up to
    /// `top` (at most max_velocity_for()).
    LimitInterval up_to(double top, double length) const;
    /// Return the largest velocity2 that is reachable at a distance `length` after (before) `square`, with the
    /// acceleration that remains there.
    double velocity2_after(double square, double length) const {
        return compute_reachable_velocities(square, length, &AxisSegmentLimits::curvature_up);
    }
    double velocity2_before(double square, double length) const {
        return compute_reachable_velocities(square, length, &AxisSegmentLimits::curvature_down);
    }

  private:
    double compute_reachable_velocities(double square, double length, double AxisSegmentLimits::*curvature) const;
};

}  // namespace motionrack::control
