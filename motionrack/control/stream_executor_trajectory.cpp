// Jerk-limited stream: the interpolator holds, resumes and overrides along its trajectory; the axes get its moves one
// by one.
#include <algorithm>
#include <motionrack/control/make_planner.hpp>
#include <motionrack/control/stream_executor.hpp>

namespace motionrack::control {

namespace {

/// s before braking at which an unfinished path is flushed. The interpolator returns nothing of the last moves until it
/// knows what follows. It is flushed if no line has come and deceleration for the end of its plan is this near.
constexpr double ends_before = 0.2;
constexpr Duration sender_is_silent = milliseconds(50);

}  // namespace

TrajectoryInterpolator StreamExecutor::make_interpolator(const Point& position) const {
    InterpolatorSettings settings;
    settings.cut_dwells = true;
    return make_trajectory_interpolator(*axes_, settings_.gcode.limits, settings_.accel_reserve, settings, position);
}

Result<ExecutionState> StreamExecutor::drive_trajectory(bool more_may_come) {
    if (request_ != StopRequest::none) {
        if (!path_begun_) return enter_standstill();
        interpolator_->generator().hold();
    } else if (state_ == ExecutionState::feed_hold || state_ == ExecutionState::paused) {
        return state_;
    }
    pull_steps();
    interpolator_->generator().set_overrides(feed_wanted_, rapid_wanted_);
    if (Result<void> filled = fill_interpolator(); !filled) {
        forget();
        return tl::unexpected<Error>(filled.error());
    }
    const bool rest_follows = !more_may_come || planned_ < entries_.size();
    if (trajectory_may_wait(rest_follows)) return state_ = ExecutionState::waiting;
    const bool late =
        interpolator_->generator().seconds_to_braking() < ends_before && host_.now() > last_push_ + sender_is_silent;
    if (!trajectory_ends_ && (rest_follows || late) && interpolator_->has_room()) {
        interpolator_->flush();
        trajectory_ends_ = true;
    }
    if (PlannedMove planned; interpolator_->pull(planned, true)) return submit(planned);
    const bool more_follows = !trajectory_ends_ && !rest_follows && request_ == StopRequest::none;
    if (path_begun_) {
        // The interpolator is stationary: at the end of the known path, or on hold.
        Result<ExecutionState> finished = finish_path();
        if (!finished || !more_follows) return finished;
    } else {
        pop_driven(interpolator_->generator().first_pending_move());  // dwells of zero duration
    }
    return more_follows ? state_ = ExecutionState::waiting : enter_standstill();
}

/// Returns true while a single first move waits for the line after it, so that it need not end at standstill.
bool StreamExecutor::trajectory_may_wait(bool rest_follows) const {
    return !rest_follows && !path_begun_ && request_ == StopRequest::none && planned_ == 1 && !trajectory_ends_;
}

Result<void> StreamExecutor::fill_interpolator() {
    for (; interpolator_->has_room() && planned_ < entries_.size() && !stops_before(entries_[planned_]); ++planned_) {
        QueueEntry& entry = entries_[planned_];
        if (!entry.is_move()) continue;
        entry.number = interpolator_->generator().pushed();
        MOTIONRACK_CHECK(interpolator_->push(entry.step.move, entry.is_overridable()));
        trajectory_ends_ = false;
        last_push_ = host_.now();
    }
    return {};
}

/// Removes the moves before a block. With an interpolator one move becomes several blocks; otherwise one block may
/// cover several moves.
void StreamExecutor::pop_before_block(std::int64_t block) {
    for (; first_block_ < block; ++first_block_) {
        for (std::int64_t left = interpolator_ ? 0 : blocks_.front(); left > 0; pop())
            left -= entries_.front().is_move();
        blocks_.pop_front();
    }
    if (interpolator_) pop_driven(blocks_.front());
}

/// Removes all entries up to the last move before this one.
void StreamExecutor::pop_driven(std::int64_t first_pending_move) {
    std::size_t driven = 0;
    for (std::size_t i = 0; i < planned_; ++i)
        if (entries_[i].is_move()) {
            if (entries_[i].number >= first_pending_move) break;
            driven = i + 1;
        }
    for (; driven > 0; --driven) pop();
}

}  // namespace motionrack::control
