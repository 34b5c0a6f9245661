// The speed over a line whose ends take less jerk: the quickest of all profiles that speed up and slow down once.
//
//   jerk    J ┌──┐        ┌─┐            speed      ╱▔▔╲         the eased ends are launched over and
//           s J │ │       │ │ s J                  ╱    ╲        landed on with their own jerk,
//         ────┴──┴─┐   ┌──┴─┴────             __╱        ╲__     between them it is an S-curve
//          -J      └───┘                    eased       eased
#pragma once

#include <motionrack/control/path_velocity/limit_interval.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

/// From rest to rest. False, and nothing is written, where the spans are not such a line, or the ends too long for it
/// to be the quickest.
bool write_reduced_jerk_profile(std::span<const LimitInterval> spans, std::vector<ProfileSegment>& out);

}  // namespace motionrack::control
