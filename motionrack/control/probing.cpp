// Plan of a single move.
#include <fmt/format.h>

#include <motionrack/control/make_planner.hpp>
#include <motionrack/control/probing.hpp>

namespace motionrack::control {

Result<PlannedMove> plan_single_move(AxisGroup& axes, const MachineLimits& limits, double accel_reserve,
                                     const Move& move) {
    LookAheadPlanner planner = make_look_ahead_planner(axes, limits, accel_reserve, {}, axes.commanded_position());
    MOTIONRACK_CHECK(planner.push(move));
    planner.flush();
    PlannedMove planned;
    if (planner.pull(planned)) return planned;
    return fail(ErrorKind::invalid_input, fmt::format("The probing move of line {} has no length.", move.line),
                {move.line, 1});
}

std::string probe_text(gcode::Probe probe, const ProbeResult& outcome) {
    const bool leaves = gcode::probe_leaves(probe);
    const auto place = fmt::format("X {:.4f} Y {:.4f} Z {:.4f}", outcome.at[0], outcome.at[1], outcome.at[2]);
    if (outcome.hit) return fmt::format("probe {} at {}", leaves ? "left" : "touched", place);
    return fmt::format("probe did not {} before the end of its move at {}", leaves ? "leave" : "touch", place);
}

}  // namespace motionrack::control
