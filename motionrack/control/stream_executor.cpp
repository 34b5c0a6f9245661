// Entries pass from the reader to the planner to the axes, and are removed at the front when the machine has passed
// them.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/make_planner.hpp>
#include <motionrack/control/split_move.hpp>
#include <motionrack/control/stream_executor.hpp>
#include <utility>

namespace motionrack::control {

namespace {

using gcode::CanonCall;
using gcode::CanonCallKind;

/// Largest sweep of a slice of an arc: short enough that a position on it is unambiguous.
constexpr double max_sweep = 2 * pi / 3;
/// Minimum length of a slice: long enough that rounding its ends to whole pulses does not matter.
constexpr double min_pulses = 200;

}  // namespace

StreamExecutor::StreamExecutor(AxisGroup& axes, Interrupt& host, const StreamExecutorSettings& settings)
    : axes_(&axes),
      host_(host),
      settings_(settings),
      limits_(settings.gcode.limits),
      interpreter_(settings.gcode),
      planner_(make_look_ahead_planner(axes, settings.gcode.limits, settings.accel_reserve, settings.planner,
                                       settings.gcode.start)),
      read_to_(settings.gcode.start) {
    if (settings_.jerk_limited) interpolator_ = make_interpolator(settings.gcode.start);
}

// ---- reading

gcode::Outcome<void> StreamExecutor::line(std::string_view text, std::int32_t number) {
    text_ = text;
    if (gcode::Outcome<void> read = interpreter_.line(text_, number); !read) return read;
    unpulled_ = line_begins_ = true;
    pull_steps();
    return {};
}

gcode::Outcome<void> StreamExecutor::line(std::string_view text, std::int32_t number,
                                          gcode::ProgramFlow& program_flow) {
    text_ = text;
    gcode::Outcome<void> read = interpreter_.line(text_, number, gcode::Language::program);
    if (!read) {
        program_flow.line_rejected(text_, read.error());
        return read;
    }
    if (gcode::Outcome<void> taken = program_flow.line_accepted(interpreter_); !taken) return taken;
    unpulled_ = line_begins_ = true;
    pull_steps();
    return {};
}

gcode::Outcome<void> StreamExecutor::program_over() {
    if (gcode::Outcome<void> done = interpreter_.finish(); !done) return done;
    unpulled_ = line_begins_ = true;
    pull_steps();
    return {};
}

void StreamExecutor::move(const Move& move) {
    CanonCall step;
    step.line = move.line;
    step.move = move;
    begin_cut(step, true);
    interpreter_.resync_position(move.end);
    unpulled_ = line_begins_ = true;
    pull_steps();
}

void StreamExecutor::pull_steps() {
    while (entries_.size() < settings_.max_entries) {
        if (cutting_) {
            add_piece();
            continue;
        }
        const CanonCall* step = unpulled_ ? interpreter_.pull() : nullptr;
        unpulled_ = step != nullptr;
        if (step == nullptr) return;
        further_steps_ += !std::exchange(line_begins_, false);
        if (step->probe != gcode::Probe::none) {
            probe_waits_ = true;
            ++moves_;
            entries_.push_back({*step, {}, read_to_});
            entries_.back().step.move.index = read_++;
            if (on_move_) on_move_(entries_.back().step.move, read_to_);
        } else if (step->kind == CanonCallKind::move && step->move.kind != MoveKind::dwell) {
            begin_cut(*step, false);
        } else {
            entries_.push_back({*step, std::string(step->text), read_to_});
            if (step->kind != CanonCallKind::move) continue;
            ++moves_;
            entries_.back().step.move.index = read_++;
            if (on_move_) on_move_(entries_.back().step.move, read_to_);
        }
    }
}

void StreamExecutor::begin_cut(const CanonCall& step, bool by_hand) {
    Cutting cut{step, geometry_of(step.move, read_to_)};
    cut.by_hand = by_hand;
    cut.step.move.index = read_++;
    if (on_move_) on_move_(cut.step.move, read_to_);
    if (cut.path.shape == PathShape::nothing) return;
    const double wanted = limits_.along(cut.path, step.move).velocity * settings_.slice_s;
    const Point components = max_tangent_components(cut.path);
    double pulses = 0;  // pulses of the fastest axis per unit of length
    for (std::size_t i = 0; i < components.size(); ++i)
        pulses = std::max(pulses, components[i] * settings_.gcode.limits[i].pulses_per_unit);
    const double pieces = std::min(cut.path.length / wanted, cut.path.length * pulses / min_pulses);
    // Point-to-point axes would stop at the end of each slice.
    if (!interpolator_ && !settings_.gcode.point_to_point)
        cut.pieces = static_cast<int>(
            std::max(1.0, std::ceil(std::min(std::max(pieces, std::fabs(cut.path.sweep) / max_sweep), 1e9))));
    cutting_ = cut;
    ++moves_;
}

void StreamExecutor::add_piece() {
    const double each = cutting_->path.length / cutting_->pieces;
    const double from = each * cutting_->done++;
    const bool last = cutting_->done == cutting_->pieces;
    QueueEntry piece{cutting_->step, {}, read_to_};
    piece.last = last;
    piece.by_hand = cutting_->by_hand;
    Move& move = piece.step.move;
    move = sub_move(cutting_->step.move, cutting_->path, from, last ? cutting_->path.length : each * cutting_->done);
    if (!last && move.path == PathControl::exact_stop) move.path = PathControl::exact_path;
    read_to_ = move.end;
    entries_.push_back(std::move(piece));
    if (last) cutting_.reset();
}

// ---- operator requests

void StreamExecutor::hold() {
    if (request_ == StopRequest::stop || state_ == ExecutionState::feed_hold || state_ == ExecutionState::paused)
        return;
    if (!path_begun_ && !has_work()) {
        state_ = ExecutionState::feed_hold;
        return;
    }
    request_ = StopRequest::hold;
    stop_flag_ = !interpolator_ && !last_probe_.runs;
}

void StreamExecutor::resume() {
    if (state_ != ExecutionState::feed_hold && state_ != ExecutionState::paused) return;
    state_ = ExecutionState::running;
    if (interpolator_) interpolator_->generator().resume();
}

void StreamExecutor::stop() {
    if (!path_begun_ && !has_work()) {
        // A pause with no pending entry would block the next line.
        if (state_ == ExecutionState::feed_hold || state_ == ExecutionState::paused) state_ = ExecutionState::idle;
        return;
    }
    request_ = StopRequest::stop;
    stop_flag_ = !interpolator_ || last_probe_.runs;
}

void StreamExecutor::set_overrides(double feed, double rapid) {
    feed_wanted_ = std::clamp(feed, 0.01, 2.0);
    rapid_wanted_ = std::clamp(rapid, 0.01, 1.0);
}

// ---- execution

Result<ExecutionState> StreamExecutor::drive(bool more_may_come) {
    if (interpolator_) return drive_trajectory(more_may_come);
    const bool brakes = request_ != StopRequest::none;
    if (brakes && !path_begun_) return enter_standstill();
    if (!brakes && (state_ == ExecutionState::feed_hold || state_ == ExecutionState::paused)) return state_;
    pull_steps();
    if (!brakes && (feed_ != feed_wanted_ || rapid_ != rapid_wanted_)) {
        feed_ = feed_wanted_;
        rapid_ = rapid_wanted_;
        std::size_t at = handed_;
        planner_.change_feeds([&](PlannedMove& planned) {
            while (!entries_[at].is_move()) ++at;
            entries_[at].override_feed(planned.move, feed_, rapid_);
            for (std::int32_t left = planned.moves; left > 0; ++at) left -= entries_[at].is_move();
        });
    }
    if (Result<void> filled = fill_planner(); !filled) {
        forget();
        return tl::unexpected<Error>(filled.error());
    }
    // Holds a last move back while there is time for the line after it, so that it need not end at standstill. A hold
    // or stop submits it: deceleration may need the whole known path.
    const bool rest_follows = !more_may_come || planned_ < entries_.size();
    const bool keep_back = !rest_follows && !brakes && (path_begun_ ? time_left() : planner_.size() > 0);
    if (planner_.size() <= 1 && keep_back) return state_ = ExecutionState::waiting;
    if (PlannedMove planned; planner_.pull_early(planned)) return submit(planned);
    return path_begun_ ? finish_path() : enter_standstill();
}

Result<void> StreamExecutor::fill_planner() {
    for (; planner_.has_room() && planned_ < entries_.size() && !stops_before(entries_[planned_]); ++planned_) {
        const QueueEntry& entry = entries_[planned_];
        if (!entry.is_move()) {
            planner_.keep_apart();  // an event must keep its position between the moves
            continue;
        }
        Move move = entry.step.move;
        entry.override_feed(move, feed_, rapid_);
        MOTIONRACK_CHECK(planner_.push(move));
    }
    return {};
}

bool StreamExecutor::stops_before(const QueueEntry& entry) const {
    if (single_block_ && entry.step.line != entries_.front().step.line) return true;
    return entry.is_probe() || gcode::needs_standstill(entry.step);
}

/// Returns true if the submitted path lasts longer than the margin.
bool StreamExecutor::time_left() {
    if (block_began_ == never) return false;
    double seconds = 0;
    for (std::size_t i = 0; i < handed_; ++i) seconds += entries_[i].seconds;
    return block_began_ + from_seconds(seconds) > host_.now() + settings_.margin;
}

Result<ExecutionState> StreamExecutor::submit(const PlannedMove& planned) {
    if (!path_begun_) {
        if (Result<void> begun = axes_->begin(); !begun) return interrupted(begun.error());
        path_begun_ = true;
        path_block_ += std::exchange(first_block_, 0);
        block_began_ = never;
        blocks_.clear();
    }
    if (interpolator_) {
        blocks_.push_back(planned.number);
    } else {
        blocks_.push_back(planned.moves);
        double seconds = seconds_of(planned);
        for (std::int32_t left = planned.moves; left > 0; ++handed_)
            if (entries_[handed_].is_move()) {
                entries_[handed_].seconds = std::exchange(seconds, 0.0);
                --left;
            }
    }
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
    first_block_ += static_cast<std::int64_t>(blocks_.size());
    blocks_.clear();
    if (interpolator_) pop_driven(interpolator_->generator().first_pending_move());
    while (handed_ > 0) pop();
    if (single_block_ && has_work() && request_ == StopRequest::none) return state_ = ExecutionState::paused;
    if (interpolator_ && request_ == StopRequest::hold && !has_work()) interpolator_->generator().resume();
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
    while (!entries_.empty() && !entries_.front().is_move()) {
        if (entries_.front().is_probe()) return probe();
        const bool pause = entries_.front().step.kind == CanonCallKind::pause;
        pop();
        if (pause) return state_ = ExecutionState::paused;
    }
    return state_ = has_work() ? ExecutionState::running : ExecutionState::idle;
}

Result<ExecutionState> StreamExecutor::interrupted(const Error& error) {
    const bool held = !interpolator_ && error.kind == ErrorKind::stopped && request_ == StopRequest::hold;
    request_ = StopRequest::none;
    stop_flag_ = false;
    path_begun_ = false;
    if (held) keep_rest_of_path();
    first_block_ += static_cast<std::int64_t>(blocks_.size());
    blocks_.clear();
    if (held) return state_ = ExecutionState::feed_hold;
    forget();
    if (error.kind == ErrorKind::stopped) return state_;
    return tl::unexpected<Error>(error);
}

void StreamExecutor::forget() {
    // Reading a card's position may take time, in which lines and a hold or stop come: they are discarded, too.
    const Point position = axes_->commanded_position();
    request_ = StopRequest::none;
    stop_flag_ = false;
    entries_.clear();
    cutting_.reset();
    moves_ = 0;
    unpulled_ = probe_waits_ = false;
    planned_ = handed_ = 0;
    state_ = ExecutionState::idle;
    interpreter_.reset_after_program();
    read_to_ = position;
    interpreter_.resync_position(position);
    new_planner(position);
}

void StreamExecutor::resync_axes(AxisGroup& axes) {
    axes_ = &axes;
    read_to_ = axes_->commanded_position();
    interpreter_.resync_position(read_to_);
    new_planner(read_to_);
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
    line_driven_ = 0;
}

void StreamExecutor::clear_offsets() {
    gcode::Settings settings = fresh_settings();
    settings.work_offsets = {};
    settings.g28 = settings.g30 = {};
    interpreter_ = gcode::Interpreter(settings);
}

void StreamExecutor::new_planner(const Point& position) {
    planner_ =
        make_look_ahead_planner(*axes_, settings_.gcode.limits, settings_.accel_reserve, settings_.planner, position);
    if (interpolator_) interpolator_ = make_interpolator(position);
    trajectory_ends_ = true;
}

// ---- entries that the machine has passed

void StreamExecutor::take_move_starts() {
    for (const MoveStart& start : axes_->take_move_starts()) {
        if (start.block < 0) continue;
        block_began_ = start.at;
        pop_before_block(start.block);
        while (!entries_.empty() && !entries_.front().is_move()) pop();
        line_driven_ = start.line;
    }
}

/// Removes the first entry.
void StreamExecutor::pop() {
    QueueEntry& front = entries_.front();
    if (front.is_move()) {
        moves_ -= front.last;
    } else {
        line_driven_ = front.step.line;
        front.step.text = front.text;
        if (on_event_) on_event_(front.step, path_block_ + first_block_ - 1);
    }
    entries_.pop_front();
    planned_ -= planned_ > 0;
    handed_ -= handed_ > 0;
}

}  // namespace motionrack::control
