// All axes at one instant of a ride.
#pragma once

#include <cstdint>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <motionrack/control/trajectory/section_overlap.hpp>

namespace motionrack::control {

/// Per s, s^2, s^3.
struct TrajectoryPoint {
    double u = 0;
    Point place = {}, speed = {}, accel = {}, jerk = {};
    std::int32_t line = 0;
};

/// Where the motion along a piece has the axes; a place beside the piece counts as its end.
TrajectoryPoint trajectory_point(const CubicSegment& piece, const PathMotion& along);

/// Adds a stretch that has still `seconds` to its end, which is straight there: what it has still to go is missing.
void add_overlap(TrajectoryPoint& state, const SectionRamp& end, double seconds);

}  // namespace motionrack::control
