// State of all axes at one instant of a trajectory.
#pragma once

#include <cstdint>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <motionrack/control/trajectory/section_overlap.hpp>

namespace motionrack::control {

/// Positions of all axes and their derivatives, per s, s^2 and s^3.
struct TrajectoryPoint {
    double u = 0;
    Point position = {}, velocity = {}, accel = {}, jerk = {};
    std::int32_t line = 0;
};

/// Returns the state of the axes for a motion along a segment; clamps positions outside the segment.
TrajectoryPoint trajectory_point(const CubicSegment& piece, const PathMotion& along);

/// Adds the remaining motion of a section that ends in `seconds` s and is straight there, by subtracting its remaining
/// distance.
void add_overlap(TrajectoryPoint& state, const SectionRamp& end, double seconds);

}  // namespace motionrack::control
