// A part of a feed profile, over the path and over time.
//
//   speed^2 w over the path u                         launch: constant jerk from rest, w ~ u^(4/3)
//       │   ╭───────╮                                 cell:   w is a parabola, w = w0 + slope x + bend x^2/2
//       │  ╱         ╲                                landing: constant jerk into rest
//       │╭╯           ╰╮                               ramp:   constant jerk between two speeds
//       └┴─┴──┴───┴──┴─┴──► u                         acceleration = w'/2, jerk = speed w''/2
//
// On a cell the motion in time is the solution of x'' = (slope + bend x)/2, so it is known in closed form.
#pragma once

#include <cstdint>

namespace motionrack::control {

/// The motion along the path at one instant.
struct PathMotion {
    double u = 0;  ///< u
    double speed = 0;
    double accel = 0;
    double jerk = 0;
};

enum class ProfileSegmentKind : std::uint8_t { launch, cell, ramp, landing };

struct ProfileSegment {
    ProfileSegmentKind phase = ProfileSegmentKind::cell;
    double begin = 0;  ///< u
    double length = 0;
    double seconds = 0;
    double velocity2 = 0;            ///< cell, ramp: of the speed at its begin
    double velocity2_slope = 0;      ///< cell, ramp: of the square over the path, at its begin
    double velocity2_curvature = 0;  ///< cell: change of the slope over the path
    double jerk = 0;                 ///< all but a cell

    /// `time` from the piece's begin, 0 .. seconds.
    PathMotion at(double time) const;
    /// at(seconds), quicker.
    PathMotion last() const;
};

/// A cell with about its time, exactly if it has no bend. `square` is above 0 all over it, but at an end beside a rest
/// it may be rounded to 0.
ProfileSegment approximate_cell(double begin, double length, double square, double slope, double bend);
/// Gives a cell its exact time.
void settle(ProfileSegment& piece);
/// A cell with its exact time.
ProfileSegment feed_cell(double begin, double length, double square, double slope, double bend);
/// Constant jerk from a speed and an acceleration; both and the jerk may be of any sign as long as the place rises.
ProfileSegment feed_ramp(double begin, double length, double seconds, double speed, double accel, double jerk);
/// Rest at `begin`, and the square of the speed at the other end; or the other way round.
ProfileSegment feed_launch(double begin, double length, double square);
ProfileSegment feed_landing(double begin, double length, double square);

}  // namespace motionrack::control
