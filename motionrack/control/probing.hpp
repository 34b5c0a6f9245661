// What a probing move needs beside the path: its own plan, and words for how it ended.
#pragma once

#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <string>

namespace motionrack::control {

/// One move from rest to rest by trapezoids, from where the axes stand. Errors: it is too short to be driven, or not
/// finite.
Result<PlannedMove> plan_single_move(AxisGroup& axes, const MachineLimits& limits, double accel_reserve,
                                     const Move& move);

/// "probe touched at X 10.0000 Y 0.0000 Z -3.2150", "probe did not touch on the way to ..".
std::string probe_text(gcode::Probe probe, const ProbeResult& outcome);

}  // namespace motionrack::control
