// Main loop of a part program.
#include <fmt/format.h>

#include <motionrack/control/make_planner.hpp>
#include <motionrack/control/probing.hpp>
#include <motionrack/control/program_executor.hpp>

namespace motionrack::control {

ProgramExecutor::ProgramExecutor(AxisGroup& axes, const ExecutorSettings& settings) : axes_(axes), settings_(settings) {
    plan_from(settings.gcode.start);
}

void ProgramExecutor::plan_from(const Point& start) {
    read_to_ = start;
    if (settings_.jerk_limited)
        planner_ = std::make_unique<TrajectoryInterpolator>(
            make_trajectory_interpolator(axes_, settings_.gcode.limits, settings_.accel_reserve, {}, start));
    else
        planner_ = std::make_unique<LookAheadPlanner>(
            make_look_ahead_planner(axes_, settings_.gcode.limits, settings_.accel_reserve, settings_.planner, start));
}

Result<void> ProgramExecutor::submit() {
    PlannedMove planned;
    while (true) {
        if (!held_ && is_stop_requested()) held_ = planner_->hold();
        if (!planner_->pull(planned)) return held_ ? stopped() : Result<void>{};
        report_move(planned);
        MOTIONRACK_CHECK(axes_.follow(planned));
    }
}

/// Returns the move that was read, with its number.
Move ProgramExecutor::programmed(const Move& read) {
    Move move = read;
    move.index = read_++;
    if (on_move_) on_move_(move, read_to_);
    if (move.kind != MoveKind::dwell) read_to_ = move.end;
    return move;
}

/// Notifies the caller of a planned move before it is submitted.
void ProgramExecutor::report_move(const PlannedMove& planned) {
    summary_.add(planned);
    if (on_block_) on_block_(blocks_, planned);
    ++blocks_;
    line_ = planned.move.line;
}

/// Executes the queue of the axes to standstill and reports the stop.
Result<void> ProgramExecutor::stopped() {
    MOTIONRACK_CHECK(axes_.finish());
    return stopped_on_request(line_, axes_.commanded_position(), settings_.gcode.limits);
}

void ProgramExecutor::remember(const gcode::CanonCall& step, ProgramResult& run) {
    run.add(ProgramEvent{step.line, blocks_ - 1, event_text(step)});
}

Result<void> ProgramExecutor::take(const gcode::CanonCall& step, ProgramResult& run) {
    using gcode::CanonCallKind;
    if (step.kind == CanonCallKind::move) {
        run.moves += step.move.kind != MoveKind::dwell;
        if (!planner_->has_room()) MOTIONRACK_CHECK(submit());
        return planner_->push(programmed(step.move));
    }
    // Calls that need standstill wait for it; a spindle or coolant word does not interrupt the path.
    if (gcode::needs_standstill(step)) {
        planner_->flush();
        MOTIONRACK_CHECK(submit());
    }
    remember(step, run);
    if (step.kind == CanonCallKind::end) run.ended = true;
    return {};
}

/// Executes all moves before the probing move, then the probing move alone; the program continues at its final
/// position.
Result<void> ProgramExecutor::probe(const gcode::CanonCall& step, gcode::ProgramReader& reader, ProgramResult& run) {
    run.moves += 1;
    planner_->flush();
    MOTIONRACK_CHECK(submit());
    MOTIONRACK_CHECK(axes_.finish());
    MOTIONRACK_TRY(const PlannedMove planned,
                   plan_single_move(axes_, settings_.gcode.limits, settings_.accel_reserve, programmed(step.move)));
    report_move(planned);
    MOTIONRACK_TRY(const ProbeResult outcome, axes_.probe(planned, gcode::probe_leaves(step.probe)));
    const Point stopped_at = axes_.commanded_position();
    reader.set_probe_result(outcome.hit, outcome.at, stopped_at);
    plan_from(stopped_at);
    run.add(ProgramProbe{step.line, step.probe, outcome}, blocks_ - 1);
    const std::string what = probe_text(step.probe, outcome);
    if (outcome.hit || !gcode::probe_must(step.probe)) return {};
    return fail(ErrorKind::machine, fmt::format("In line {} the {}. Nothing after it was executed.", step.line, what),
                {step.line, 1});
}

Result<void> ProgramExecutor::run(std::string_view text, const std::string& file, ProgramResult& run) {
    MOTIONRACK_CHECK(axes_.begin());
    gcode::ProgramReader reader(text, settings_.gcode, file);
    Result<void> outcome;
    while (outcome) {
        auto step = reader.next();
        run.lines = reader.program_flow().highest_line();
        if (!step) {
            outcome = tl::unexpected<Error>(step.error());
            break;
        }
        if (*step == nullptr) break;
        outcome = (*step)->probe != gcode::Probe::none ? probe(**step, reader, run) : take(**step, run);
    }
    // Executes the moves read before an error, so that the machine stops at the programmed position.
    const bool axes_stopped =
        !outcome && (outcome.error().kind == ErrorKind::machine || outcome.error().kind == ErrorKind::stopped);
    if (!axes_stopped) {
        planner_->flush();
        Result<void> rest = submit();
        if (rest) rest = axes_.finish();
        if (outcome) outcome = rest;
    }
    run.plan = summary_;
    return outcome;
}

}  // namespace motionrack::control
