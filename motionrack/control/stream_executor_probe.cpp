// A probing move of a stream: alone, from standstill to standstill; no line is read before it has ended.
#include <fmt/format.h>

#include <motionrack/control/stream_executor.hpp>

namespace motionrack::control {

Result<ExecutionState> StreamExecutor::probe() {
    const gcode::CanonCall step = queue_.front().step;
    queue_.set_line(step.line);
    last_probe_ = {last_probe_.count, step.line, step.probe, false, false, {}};
    const Result<PlannedMove> planned =
        plan_single_move(*axes_, settings_.gcode.limits, settings_.accel_reserve, step.move);
    if (!planned) return interrupted(planned.error());
    last_probe_.runs = true;  // a hold waits from here on
    const Result<void> begun = axes_->begin();
    last_probe_.runs = begun.has_value();
    if (!begun) return interrupted(begun.error());
    state_ = ExecutionState::running;
    queue_.pass_blocks(1);
    const Result<ProbeResult> outcome = axes_->probe(*planned, gcode::probe_leaves(step.probe));
    last_probe_.runs = false;
    axes_->take_move_starts();
    const Point position = axes_->commanded_position();
    if (!outcome) {
        if (request_ != StopRequest::stop) ++last_probe_.count;
        if (request_ == StopRequest::hold) request_ = StopRequest::none;  // something else ended the move
        return interrupted(outcome.error());
    }
    last_probe_ = {last_probe_.count + 1, step.line, step.probe, true, false, *outcome};
    queue_.end_probe(position);
    interpreter_.set_probe_result(outcome->hit, outcome->at, position);
    plan_->reset(*axes_, position);
    if (!last_probe_.failed()) {
        if (single_block_ && request_ == StopRequest::none) request_ = StopRequest::pause;
        // A request takes effect in the next drive(): the line that it affects is read only now.
        return state_ = has_work() || request_ != StopRequest::none ? ExecutionState::running : ExecutionState::idle;
    }
    forget();
    return fail(
        ErrorKind::machine,
        fmt::format("In line {} the {}. Nothing after it was executed.", step.line, probe_text(step.probe, *outcome)),
        {step.line, 1});
}

}  // namespace motionrack::control
