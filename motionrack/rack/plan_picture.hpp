// Picture of a jerk-limited plan: the path coloured by velocity, and below it the velocity and the demands on each axis
// over time.
#pragma once

#include <motionrack/control/move.hpp>
#include <motionrack/rack/config.hpp>
#include <span>
#include <string>

namespace motionrack::rack {

/// Draws a stand-alone SVG. The programmed path lies beneath the planned one, and the velocity of the trapezoidal
/// profile beside the planned one. Acceleration and jerk are fractions of the axis limits. The axes start at standstill
/// at `start`; `moves` as for control::OfflineTrajectory.
std::string plan_picture(const std::string& title, std::span<const control::Move> moves, const RackConfig& config,
                         const control::Point& start);

}  // namespace motionrack::rack
