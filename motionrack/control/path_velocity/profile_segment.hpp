// Segment of a velocity profile, over the path and over time.
//
//   velocity^2 w over the path u                      launch: constant jerk from standstill, w ~ u^(4/3)
//       │   ╭───────╮                                 cell:   w is a parabola, w = w0 + slope x + curvature x^2/2
//       │  ╱         ╲                                landing: constant jerk to standstill
//       │╭╯           ╰╮                               ramp:   constant jerk between two velocities
//       └┴─┴──┴───┴──┴─┴──► u                         acceleration = w'/2, jerk = velocity w''/2
//
// On a cell the motion in time solves x'' = (slope + curvature x)/2, so it has a closed form.
#pragma once

#include <cstdint>

namespace motionrack::control {

/// The motion along the path at an instant.
struct PathMotion {
    double u = 0;  ///< position on the path
    double velocity = 0;
    double accel = 0;
    double jerk = 0;
};

enum class ProfileSegmentKind : std::uint8_t { launch, cell, ramp, landing };

struct ProfileSegment {
    ProfileSegmentKind phase = ProfileSegmentKind::cell;
    double begin = 0;  ///< u
    double length = 0;
    double seconds = 0;
    double velocity2 = 0;            ///< cell, ramp: at its beginning
    double velocity2_slope = 0;      ///< cell, ramp: derivative of velocity2 over the path, at its beginning
    double velocity2_curvature = 0;  ///< cell: second derivative of velocity2 over the path
    double jerk = 0;                 ///< all kinds except cell

    /// Returns the motion `time` s after the start of the segment, 0 .. seconds.
    PathMotion at(double time) const;
    /// Returns at(seconds), faster.
    PathMotion last() const;
};

/// Makes a cell with an approximate duration (exact without curvature). `square` must be above 0 on all of it; at an
/// end beside a standstill it may be rounded to 0.
ProfileSegment approximate_cell(double begin, double length, double square, double slope, double curvature);
/// Computes the exact duration of a cell.
void settle(ProfileSegment& piece);
/// Makes a cell with its exact duration.
ProfileSegment feed_cell(double begin, double length, double square, double slope, double curvature);
/// Makes a segment of constant jerk from a velocity and an acceleration. All may have any sign as long as u increases.
ProfileSegment feed_ramp(double begin, double length, double seconds, double velocity, double accel, double jerk);
/// Make a segment from standstill at `begin` to velocity2 at the end, and the reverse.
ProfileSegment feed_launch(double begin, double length, double square);
ProfileSegment feed_landing(double begin, double length, double square);

}  // namespace motionrack::control
