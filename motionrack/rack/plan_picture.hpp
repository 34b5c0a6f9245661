// A jerk-limited plan as a picture: the path coloured by its speed, and below it over time the speed and what each axis
// is asked.
#pragma once

#include <motionrack/control/move.hpp>
#include <motionrack/rack/config.hpp>
#include <span>
#include <string>

namespace motionrack::rack {

/// An SVG of its own. Beneath the path is the programmed one; beside the speed is that of the trapezoids. Acceleration
/// and jerk are parts of the axis' limits. The axes stand at `start`; `moves` as control::OfflineTrajectory takes them.
std::string plan_picture(const std::string& title, std::span<const control::Move> moves, const RackConfig& config,
                         const control::Point& start);

}  // namespace motionrack::rack
