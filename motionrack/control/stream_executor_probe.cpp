// A probing move of a stream: alone, from standstill to standstill; no line is read before it has ended.
#include <fmt/format.h>

#include <motionrack/control/stream_executor.hpp>

namespace motionrack::control {

Result<ExecutionState> StreamExecutor::probe() {
    const gcode::CanonCall step = entries_.front().step;
    line_driven_ = step.line;
    last_probe_ = {last_probe_.count, step.line, step.probe, false, false, {}};
    const Result<PlannedMove> planned =
        plan_single_move(*axes_, settings_.gcode.limits, settings_.accel_reserve, step.move);
    if (!planned) return interrupted(planned.error());
    if (Result<void> begun = axes_->begin(); !begun) return interrupted(begun.error());
    state_ = ExecutionState::running;
    ++first_block_;
    last_probe_.runs = true;
    const Result<ProbeResult> outcome = axes_->probe(*planned, gcode::probe_leaves(step.probe));
    last_probe_.runs = false;
    axes_->take_move_starts();
    const Point position = axes_->commanded_position();
    if (!outcome) {
        if (request_ != StopRequest::stop) ++last_probe_.count;
        return interrupted(outcome.error());
    }
    last_probe_ = {last_probe_.count + 1, step.line, step.probe, true, false, *outcome};
    probe_waits_ = false;
    --moves_;
    entries_.pop_front();
    planned_ = handed_ = 0;
    interpreter_.set_probe_result(outcome->hit, outcome->at, position);
    read_to_ = position;
    new_planner(position);
    if (!last_probe_.failed()) return state_ = has_work() ? ExecutionState::running : ExecutionState::idle;
    forget();
    return fail(
        ErrorKind::machine,
        fmt::format("In line {} the {}. Nothing after it was executed.", step.line, probe_text(step.probe, *outcome)),
        {step.line, 1});
}

}  // namespace motionrack::control
