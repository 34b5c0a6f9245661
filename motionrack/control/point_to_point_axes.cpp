// Executes one move after another.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/point_to_point_axes.hpp>
#include <utility>

namespace motionrack::control {

namespace {

constexpr Duration poll_period = milliseconds(1);

}  // namespace

PointToPointAxes::PointToPointAxes(const std::array<Axis*, axis_count>& axes, const MachineLimits& limits,
                                   Interrupt& host)
    : axes_(axes), limits_(limits), host_(host) {}

void PointToPointAxes::look_where_they_stand() {
    for (std::size_t i = 0; i < axes_.size(); ++i) commanded_[i] = axes_[i] != nullptr ? axes_[i]->position() : 0;
    known_ = true;
}

Point PointToPointAxes::commanded_position() {
    if (!known_) look_where_they_stand();
    return commanded_;
}

Result<void> PointToPointAxes::begin() {
    blocks_ = 0;
    starts_.clear();
    look_where_they_stand();
    return {};
}

double PointToPointAxes::velocity_of(const PlannedMove& move, std::size_t axis) const {
    const double max_velocity = limits_[axis].max_velocity;
    if (move.move.kind == MoveKind::rapid) return max_velocity;
    const double feed = move.move.feed_mode == FeedMode::inverse_time ? move.move.feed * move.length : move.move.feed;
    return std::min(feed, max_velocity);
}

/// Starts every axis of the move; if one refuses, stops the others.
Result<void> PointToPointAxes::order(const PlannedMove& move) {
    const auto moves = [&](std::size_t i) { return axes_[i] != nullptr && move.move.end[i] != move.start[i]; };
    int moving = 0;
    for (std::size_t i = 0; i < axes_.size(); ++i) moving += moves(i);
    if (move.move.kind == MoveKind::arc || (move.move.kind == MoveKind::feed && moving > 1))
        return fail(
            ErrorKind::refused,
            fmt::format("Line {} needs axes that move together, but these position one by one. It was not moved; write "
                        "straight moves of one axis.",
                        move.move.line));
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (!moves(i)) continue;
        if (Result<void> begun = axes_[i]->move_to(move.move.end[i], velocity_of(move, i)); !begun) {
            stop(false);
            static_cast<void>(wait());
            return begun;
        }
        commanded_[i] = move.move.end[i];
    }
    return {};
}

/// Waits for standstill of all axes. An axis that fails, or a stop request, stops the others.
Result<void> PointToPointAxes::wait() {
    Result<void> ended;
    while (true) {
        bool busy = false;
        for (Axis* axis : axes_) {
            if (axis == nullptr) continue;
            axis->step(host_.now());
            const AxisState state = axis->state();
            if (state != AxisState::standstill && state != AxisState::error)
                busy = true;
            else if (Result<void> good = axis->wait(Duration{0}); !good && ended) {
                ended = std::move(good);
                stop(false);
            }
        }
        if (!busy) return ended;
        if (ended && host_.stop_requested()) {
            ended = fail(ErrorKind::stopped, "Stopped on request; every axis stopped with its own deceleration.");
            stop(false);
        }
        host_.pass(poll_period);
    }
}

Result<void> PointToPointAxes::dwell(double seconds) {
    const Instant end = later(host_.now(), from_seconds(seconds));
    while (host_.now() < end) {
        if (host_.stop_requested())
            return fail(ErrorKind::stopped, "Stopped on request in a dwell; the axes are at standstill.");
        host_.pass(std::min(milliseconds(50), end - host_.now()));
    }
    return {};
}

Result<void> PointToPointAxes::follow(const PlannedMove& move) {
    starts_.push_back({blocks_++, move.move.line, host_.now()});
    if (host_.stop_requested())
        return fail(ErrorKind::stopped, "Stopped on request before a move; the axes are at standstill.",
                    {move.move.line, 0});
    Result<void> done = move.move.kind == MoveKind::dwell ? dwell(move.move.seconds) : order(move);
    if (done && move.move.kind != MoveKind::dwell) done = wait();
    if (done) return done;
    known_ = false;  // they stop somewhere on the way
    if (done.error().location.line == 0) done.error().location.line = move.move.line;
    return done;
}

Result<void> PointToPointAxes::finish() {
    starts_.push_back({-1, 0, host_.now()});
    return {};
}

void PointToPointAxes::stop(bool immediate) {
    for (Axis* axis : axes_) {
        if (axis == nullptr) continue;
        immediate ? axis->stop_now() : axis->stop();
    }
}

std::vector<MoveStart> PointToPointAxes::take_move_starts() {
    return std::exchange(starts_, {});
}

}  // namespace motionrack::control
