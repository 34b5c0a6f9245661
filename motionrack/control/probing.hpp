// Plan and report text of a probing move.
#pragma once

#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <string>

namespace motionrack::control {

/// Plans one move from standstill to standstill with a trapezoidal profile, from the current position. Errors: the move
/// is too short to be executed, or not finite.
Result<PlannedMove> plan_single_move(AxisGroup& axes, const MachineLimits& limits, double accel_reserve,
                                     const Move& move);

/// Returns "probe touched at X 10.0000 Y 0.0000 Z -3.2150" or "probe did not touch on the way to ..".
std::string probe_text(gcode::Probe probe, const ProbeResult& outcome);

}  // namespace motionrack::control
