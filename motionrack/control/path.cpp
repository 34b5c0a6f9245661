// The look-ahead: squares of speeds, because over a move they change by the same amount whatever the speed.

#include <algorithm>
#include <cmath>
#include <motionrack/control/path.hpp>
#include <motionrack/control/profile.hpp>

namespace motionrack::control {
namespace {

constexpr int widest_window = 1'000'000;
constexpr double path_rounding = 1e-9;

std::uint64_t power_of_two_from(std::uint64_t least) {
    std::uint64_t size = 1;
    while (size < least) size *= 2;
    return size;
}

}  // namespace

Planner::Planner(const MachineLimits& limits, const Point& start, PlannerSettings settings)
    : limits_(limits), drive_(settings.drive), position_(start) {
    const auto window = static_cast<std::uint64_t>(std::clamp(settings.window, 1, widest_window));
    chunk_ = std::max<std::uint64_t>(1, window / 4);
    batch_ = window + chunk_;
    const std::uint64_t size = power_of_two_from(batch_ + 1);
    mask_ = size - 1;
    slots_.resize(size);
    nodes_.resize(size);
}

Result<void> Planner::push(const Move& move) {
    MOTIONRACK_ASSERT(has_room());
    MOTIONRACK_TRY(const Geometry path, checked_path(move, position_, limits_));
    if (move.kind == MoveKind::dwell) {
        append_dwell(move);
        return {};
    }
    if (path.shape == PathShape::nothing) return {};

    const AlongPath along = limits_.along(path, move);
    double joint = 0;
    if (tail_ != ready_) {
        joint = limits_.joint_squared(last_, last_along_.speed, path, along.speed, last_path_, last_tolerance_mm_);
        if (joint > 0 && drive_) {
            const double speed = drive_->joint_speed(last_, path);
            joint = std::min(joint, speed * speed);
        }
        if (joint == 0) flush();
    }
    append(move, path, along, joint);
    if (tail_ - ready_ >= batch_) {
        backward();
        forward(std::max(ready_ + chunk_, settled_));
    }
    return {};
}

void Planner::append_dwell(const Move& move) {
    flush();
    PlannedMove& planned = slot(tail_);
    planned = PlannedMove{};
    planned.move = move;
    planned.move.end = position_;
    planned.start = position_;
    planned.number = pushed_++;
    ready_ = settled_ = ++tail_;
}

void Planner::append(const Move& move, const Geometry& path, const AlongPath& along, double joint) {
    PlannedMove& planned = slot(tail_);
    planned.move = move;
    planned.start = position_;
    planned.number = pushed_++;
    planned.length = path.length;
    planned.accel = along.accel;
    planned.jerk = along.jerk;
    node(tail_) = {joint, 2 * along.accel * (path.length - (drive_ ? drive_->spent_length(path) : 0)),
                   along.speed * along.speed, 0};
    ++tail_;
    position_ = move.end;
    last_ = path;
    last_along_ = along;
    last_path_ = move.path;
    last_tolerance_mm_ = move.tolerance_mm;
}

void Planner::flush() {
    backward();
    forward(tail_);
}

/// From rest at the end of the window towards its start, down to the first move whose entry cannot change.
void Planner::backward() {
    const std::uint64_t last_settled = settled_;
    double entry = 0;
    for (std::uint64_t i = tail_; i > last_settled + 1;) {
        Node& here = node(--i);
        const double braked = entry + here.reach;
        if (here.joint <= braked && settled_ == last_settled) settled_ = i;
        entry = std::min(here.joint, braked);
        here.entry = entry;
    }
}

/// Makes the moves before `until` ready.
void Planner::forward(std::uint64_t until) {
    for (; ready_ < until; ++ready_) {
        const Node& here = node(ready_);
        const double after = ready_ + 1 == tail_ ? 0 : node(ready_ + 1).entry;
        const double entry = committed_ * committed_;
        PlannedMove& planned = slot(ready_);
        double exit = std::min(after, entry + here.reach);
        // After reopen() a joint may want to be slower than can be braked to.
        if (entry - here.reach - exit > path_rounding * entry) exit = entry - here.reach;
        const double top = std::min(here.cruise, 0.5 * (entry + exit + here.reach));
        planned.entry = committed_;
        planned.exit = std::sqrt(exit);
        planned.cruise = std::max({std::sqrt(top), planned.entry, planned.exit});
        if (planned.entry != 0 || planned.exit != 0) planned.jerk = 0;
        committed_ = planned.exit;
    }
    settled_ = std::max(settled_, ready_);
}

bool Planner::pull(PlannedMove& planned) {
    if (head_ == ready_) return false;
    planned = slot(head_++);
    return true;
}

bool Planner::pull_early(PlannedMove& planned) {
    if (head_ == ready_ && ready_ != tail_) {
        backward();
        forward(ready_ + 1);
    }
    return pull(planned);
}

void Planner::reopen() {
    if (head_ == tail_) return;
    committed_ = head_ == ready_ ? committed_ : slot(head_).entry;
    position_ = slot(head_).start;
    ready_ = settled_ = tail_ = head_;
}

double seconds_of(const PlannedMove& planned) {
    if (planned.move.kind == MoveKind::dwell) return planned.move.seconds;
    if (planned.jerk > 0) return SCurve(planned.length, planned.cruise, planned.accel, planned.jerk).duration();
    return Trapezoid(planned.length, planned.entry, planned.exit, planned.cruise, planned.accel).duration();
}

void PlanSummary::add(const PlannedMove& planned) {
    seconds += seconds_of(planned);
    if (planned.move.kind == MoveKind::dwell) {
        ++dwells;
        return;
    }
    ++moves;
    if (planned.exit == 0) ++stops;
    const bool linear = planned.start[0] != planned.move.end[0] || planned.start[1] != planned.move.end[1] ||
                        planned.start[2] != planned.move.end[2] || planned.move.kind == MoveKind::arc;
    if (!linear) return;
    path_mm += planned.length;
    top_speed = std::max(top_speed, planned.cruise);
}

}  // namespace motionrack::control
