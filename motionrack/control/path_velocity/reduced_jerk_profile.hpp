// Velocity profile over a line whose ends have a reduced jerk: the fastest profile with one acceleration and one
// deceleration.
//
//   jerk    J ┌──┐        ┌─┐            velocity   ╱▔▔╲         a launch over one reduced end and a landing over
//           s J │ │       │ │ s J                  ╱    ╲        the other, with their own jerk; between them a
//         ────┴──┴─┐   ┌──┴─┴────             __╱        ╲__     double-S profile
//          -J      └───┘                   reduced      reduced
#pragma once

#include <motionrack/control/path_velocity/limit_interval.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

/// Writes the profile from standstill to standstill. Returns false, and writes nothing, if the intervals are not such a
/// line or its ends are too long for this profile to be the fastest.
bool write_reduced_jerk_profile(std::span<const LimitInterval> intervals, std::vector<ProfileSegment>& out);

}  // namespace motionrack::control
