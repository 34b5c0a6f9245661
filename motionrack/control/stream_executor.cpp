// Lines pass from the interpreter to the queue, moves from the queue to the plan, planned moves from there to the axes.
#include <algorithm>
#include <motionrack/control/stream_executor.hpp>
#include <utility>

namespace motionrack::control {

namespace {

using gcode::CanonCallKind;

MoveQueueSettings queue_settings(const StreamExecutorSettings& settings) {
    // Point-to-point axes would stop at the end of each slice, and a plan with limited jerk is changed on its way.
    const bool whole = settings.jerk_limited || settings.gcode.point_to_point;
    return {settings.gcode.limits, settings.gcode.start, settings.max_entries, whole ? 0 : settings.slice_s};
}

std::unique_ptr<PathPlan> make_plan(const StreamExecutorSettings& settings, const AxisGroup& axes, Interrupt& host) {
    const PathPlanSettings plan{settings.gcode.limits, settings.accel_reserve, settings.planner};
    return settings.jerk_limited ? make_jerk_limited_plan(plan, axes, settings.gcode.start, host)
                                 : make_trapezoidal_plan(plan, axes, settings.gcode.start);
}

}  // namespace

StreamExecutor::StreamExecutor(AxisGroup& axes, Interrupt& host, const StreamExecutorSettings& settings)
    : axes_(&axes),
      host_(host),
      settings_(settings),
      interpreter_(settings.gcode),
      queue_(queue_settings(settings)),
      plan_(make_plan(settings, axes, host)) {}

// ---- reading

gcode::Outcome<void> StreamExecutor::line(std::string_view text, std::int32_t number) {
    text_ = text;
    const gcode::WorkFrame earlier = interpreter_.frame();
    if (gcode::Outcome<void> read = interpreter_.line(text_, number); !read) return read;
    queue_.read_line(interpreter_, interpreter_.changes_offsets() ? &earlier : nullptr);
    return {};
}

gcode::Outcome<void> StreamExecutor::line(std::string_view text, std::int32_t number,
                                          gcode::ProgramFlow& program_flow) {
    text_ = text;
    const gcode::WorkFrame earlier = interpreter_.frame();
    gcode::Outcome<void> read = interpreter_.line(text_, number, gcode::Language::program);
    if (!read) {
        program_flow.line_rejected(text_, read.error());
        return read;
    }
    if (gcode::Outcome<void> taken = program_flow.line_accepted(interpreter_); !taken) return taken;
    queue_.read_line(interpreter_, interpreter_.changes_offsets() ? &earlier : nullptr);
    return {};
}

gcode::Outcome<void> StreamExecutor::program_over() {
    if (gcode::Outcome<void> done = interpreter_.finish(); !done) return done;
    queue_.read_line(interpreter_);
    return {};
}

void StreamExecutor::move(const Move& move) {
    queue_.add_by_hand(move);
    interpreter_.resync_position(move.end);
    queue_.read_line(interpreter_);
}

// ---- operator requests

void StreamExecutor::hold() {
    if (request_ == StopRequest::stop || state_ == ExecutionState::feed_hold || state_ == ExecutionState::paused)
        return;
    if (!path_begun_ && !has_work()) {
        request_ = StopRequest::none;
        state_ = ExecutionState::feed_hold;
        return;
    }
    request_ = StopRequest::hold;
    stop_flag_ = !plan_->brakes_itself() && !last_probe_.runs;
}

void StreamExecutor::resume() {
    if (state_ != ExecutionState::feed_hold && state_ != ExecutionState::paused) return;
    state_ = ExecutionState::running;
    plan_->resume();
}

void StreamExecutor::stop() {
    if (!path_begun_ && !has_work()) {
        request_ = StopRequest::none;  // of a hold during a probing move that has ended
        stop_flag_ = false;
        // A pause with no pending entry would block the next line.
        if (state_ == ExecutionState::feed_hold || state_ == ExecutionState::paused) state_ = ExecutionState::idle;
        return;
    }
    request_ = StopRequest::stop;
    stop_flag_ = !plan_->brakes_itself() || last_probe_.runs;
}

void StreamExecutor::set_overrides(double feed, double rapid) {
    feed_ = std::clamp(feed, 0.01, 2.0);
    rapid_ = std::clamp(rapid, 0.01, 1.0);
    slow_rapid_down();
}

/// A rapid that was submitted as a whole can only be slowed down by a standstill on its path.
void StreamExecutor::slow_rapid_down() {
    if (request_ != StopRequest::none || !path_begun_ || plan_->rapid_override() <= rapid_) return;
    take_move_starts();  // a rapid that has ended does not count
    if (plan_->rapid_override() <= rapid_) return;
    request_ = StopRequest::replan;
    stop_flag_ = true;
}

// ---- execution

Result<ExecutionState> StreamExecutor::drive(bool more_may_come) {
    const bool brakes = request_ != StopRequest::none;
    if (brakes && !path_begun_) return enter_standstill();
    if (brakes) plan_->hold();
    if (!brakes && (state_ == ExecutionState::feed_hold || state_ == ExecutionState::paused)) return state_;
    queue_.pull(interpreter_);
    plan_->set_overrides(queue_, feed_, rapid_, brakes);
    if (Result<void> filled = fill_plan(); !filled) {
        forget();
        return tl::unexpected<Error>(filled.error());
    }
    PathOutlook outlook{!more_may_come || !queue_.all_planned(), false, brakes, path_begun_, time_left()};
    outlook.path_ends = queue_.all_planned() ? !more_may_come && queue_.all_read() : plan_->has_room();
    if (plan_->waits(queue_, outlook)) return state_ = ExecutionState::waiting;
    if (PlannedMove planned; plan_->pull(queue_, outlook, planned)) return submit(planned);
    const bool may_go_on = plan_->may_go_on(outlook);
    if (path_begun_) {
        // The end of the known path, or standstill of a plan that brakes itself.
        Result<ExecutionState> finished = finish_path();
        if (!finished || !may_go_on) return finished;
    } else {
        plan_->finish(queue_);  // dwells of zero duration
    }
    return may_go_on ? state_ = ExecutionState::waiting : enter_standstill();
}

Result<void> StreamExecutor::fill_plan() {
    for (; plan_->has_room() && !queue_.all_planned() && !stops_before(queue_.next()); queue_.take_next()) {
        if (queue_.next().is_move())
            MOTIONRACK_CHECK(plan_->push(queue_.next()));
        else
            plan_->keep_apart();  // an event must keep its position between the moves
    }
    return {};
}

bool StreamExecutor::stops_before(const QueueEntry& entry) const {
    if (single_block_ && entry.step.line != queue_.front().step.line) return true;
    return entry.is_probe() || gcode::needs_standstill(entry.step);
}

/// Returns true if the submitted path lasts longer than the margin.
bool StreamExecutor::time_left() const {
    if (block_began_ == never) return false;
    return block_began_ + from_seconds(queue_.submitted_seconds()) > host_.now() + settings_.margin;
}

Result<ExecutionState> StreamExecutor::submit(const PlannedMove& planned) {
    if (!path_begun_) {
        if (Result<void> begun = axes_->begin(); !begun) return interrupted(begun.error());
        path_begun_ = true;
        path_block_ = queue_.passed_blocks();
        block_began_ = never;
        plan_->begin_path();
    }
    plan_->submit(queue_, planned);
    slow_rapid_down();  // the override may have changed while the path was begun
    state_ = ExecutionState::running;
    const Result<void> followed = axes_->follow(planned);
    take_move_starts();
    if (!followed) return interrupted(followed.error());
    return state_;
}

Result<ExecutionState> StreamExecutor::finish_path() {
    const Result<void> finished = axes_->finish();
    take_move_starts();
    if (!finished) return interrupted(finished.error());
    path_begun_ = false;
    plan_->finish(queue_);
    if (request_ == StopRequest::replan) {
        request_ = StopRequest::none;
        stop_flag_ = false;
    }
    if (single_block_ && has_work() && request_ == StopRequest::none) return state_ = ExecutionState::paused;
    if (request_ == StopRequest::hold && !has_work()) plan_->resume();
    return enter_standstill();
}

/// Handles standstill at the end of the submitted path.
Result<ExecutionState> StreamExecutor::enter_standstill() {
    const StopRequest request = std::exchange(request_, StopRequest::none);
    stop_flag_ = false;
    if (request == StopRequest::stop) {
        forget();
        return state_;
    }
    if (request == StopRequest::hold && has_work()) return state_ = ExecutionState::feed_hold;
    if (request == StopRequest::pause && has_work()) return state_ = ExecutionState::paused;
    while (!queue_.empty() && !queue_.front().is_move()) {
        if (queue_.front().is_probe()) return probe();
        const bool pause = queue_.front().step.kind == CanonCallKind::pause;
        queue_.pop();
        if (pause) return state_ = ExecutionState::paused;
    }
    return state_ = has_work() ? ExecutionState::running : ExecutionState::idle;
}

Result<ExecutionState> StreamExecutor::interrupted(const Error& error) {
    const bool holds = request_ == StopRequest::hold;
    const bool kept =
        !plan_->brakes_itself() && error.kind == ErrorKind::stopped && (holds || request_ == StopRequest::replan);
    request_ = StopRequest::none;
    stop_flag_ = false;
    path_begun_ = false;
    if (kept) {
        const Instant stopped_at = host_.now();
        const Point position = axes_->commanded_position();
        const double seconds = block_began_ == never ? 0 : to_seconds(stopped_at - block_began_);
        queue_.keep_rest(position, plan_->moves_begun(), seconds);
        plan_->interrupt(queue_);
        plan_->reset(*axes_, position);
        return state_ = holds ? ExecutionState::feed_hold : ExecutionState::running;
    }
    plan_->interrupt(queue_);
    forget();
    if (error.kind == ErrorKind::stopped) return state_;
    return tl::unexpected<Error>(error);
}

void StreamExecutor::forget() {
    // Reading a card's position may take time, in which lines and a hold or stop come: they are discarded, too.
    const Point position = axes_->commanded_position();
    request_ = StopRequest::none;
    stop_flag_ = false;
    // Offsets outlive a reset, so those of lines that were only read must not apply.
    if (const auto earlier = queue_.clear(position)) interpreter_.restore_offsets(*earlier);
    state_ = ExecutionState::idle;
    interpreter_.reset_after_program();
    interpreter_.resync_position(position);
    plan_->reset(*axes_, position);
}

void StreamExecutor::resync_axes(AxisGroup& axes) {
    axes_ = &axes;
    const Point position = axes_->commanded_position();
    queue_.set_position(position);
    interpreter_.resync_position(position);
    plan_->reset(axes, position);
}

gcode::Settings StreamExecutor::fresh_settings() const {
    gcode::Settings settings = settings_.gcode;
    settings.start = interpreter_.position();
    settings.work_offsets = interpreter_.frame().work;
    settings.g28 = interpreter_.frame().g28;
    settings.g30 = interpreter_.frame().g30;
    return settings;
}

void StreamExecutor::reset_modal_state() {
    interpreter_ = gcode::Interpreter(fresh_settings());
    queue_.set_line(0);
}

void StreamExecutor::clear_offsets() {
    gcode::Settings settings = fresh_settings();
    settings.work_offsets = {};
    settings.g28 = settings.g30 = {};
    interpreter_ = gcode::Interpreter(settings);
}

/// Removes what the machine has passed.
void StreamExecutor::take_move_starts() {
    for (const MoveStart& start : axes_->take_move_starts()) {
        if (start.block < 0) continue;
        block_began_ = start.at;
        plan_->pass(queue_, path_block_ + start.block - queue_.passed_blocks());
        while (!queue_.empty() && !queue_.front().is_move()) queue_.pop();
        queue_.set_line(start.line);
    }
}

}  // namespace motionrack::control
