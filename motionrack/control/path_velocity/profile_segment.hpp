// Segment of a velocity profile, over the path and over time.
//
//   velocity^2 w over the path u                      from_rest: constant jerk from standstill, w ~ u^(4/3)
//       │   ╭───────╮                                 parabolic: w = w0 + slope x + curvature x^2/2
//       │  ╱         ╲                                to_rest: constant jerk to standstill
//       │╭╯           ╰╮                               constant_jerk: between two velocities
//       └┴─┴──┴───┴──┴─┴──► u                         acceleration = w'/2, jerk = velocity w''/2
//
// On a parabolic segment the motion in time solves x'' = (slope + curvature x)/2, so it has a closed form.
#pragma once

#include <cstdint>

namespace motionrack::control {

/// The motion along the path at an instant.
struct PathMotion {
    double u = 0;  ///< position on the path, mm or degrees
    double velocity = 0;
    double accel = 0;
    double jerk = 0;
};

enum class ProfileSegmentKind : std::uint8_t { from_rest, parabolic, constant_jerk, to_rest };

struct ProfileSegment {
    ProfileSegmentKind kind = ProfileSegmentKind::parabolic;
    double begin = 0;  ///< u at its start
    double length = 0;
    double seconds = 0;
    double velocity2 = 0;            ///< parabolic, constant_jerk: square of the velocity at its beginning
    double velocity2_slope = 0;      ///< parabolic, constant_jerk: derivative over the path, at its beginning
    double velocity2_curvature = 0;  ///< parabolic: second derivative of velocity2 over the path
    double jerk = 0;                 ///< constant jerk; all kinds except parabolic

    /// Returns the motion `time` s after the start of the segment, 0 .. seconds.
    PathMotion at(double time) const;
    /// Returns at(seconds), faster.
    PathMotion last() const;
};

/// Makes a parabolic segment with an approximate duration (exact without curvature). `square` must be above 0 on all of
/// it; at an end beside a standstill it may be rounded to 0.
ProfileSegment approximate_parabolic_segment(double begin, double length, double square, double slope,
                                             double curvature);
/// Sets the exact duration of a parabolic segment with an approximate one.
void settle(ProfileSegment& piece);
/// Makes a parabolic segment with its exact duration.
ProfileSegment parabolic_segment(double begin, double length, double square, double slope, double curvature);
/// Makes a segment of constant jerk from a velocity and an acceleration. All may have any sign as long as u increases.
ProfileSegment constant_jerk_segment(double begin, double length, double seconds, double velocity, double accel,
                                     double jerk);
/// Make a segment from standstill at `begin` to velocity2 at the end, and the reverse.
ProfileSegment from_rest_segment(double begin, double length, double square);
ProfileSegment to_rest_segment(double begin, double length, double square);

}  // namespace motionrack::control
