// Look-ahead with squares of velocities: over a move they change by the same amount at any velocity.

#include <algorithm>
#include <cmath>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/rest_profiles.hpp>
#include <utility>

namespace motionrack::control {
namespace {

constexpr int widest_window = 1'000'000;
constexpr double path_rounding = 1e-9;

std::uint64_t power_of_two_from(std::uint64_t min_size) {
    std::uint64_t size = 1;
    while (size < min_size) size *= 2;
    return size;
}

}  // namespace

LookAheadPlanner::LookAheadPlanner(const MachineLimits& limits, const Point& start, LookAheadSettings settings)
    : limits_(limits), drive_(settings.drive), position_(start) {
    const auto window = static_cast<std::uint64_t>(std::clamp(settings.window, 1, widest_window));
    chunk_ = std::max<std::uint64_t>(1, window / 4);
    batch_ = window + chunk_;
    const std::uint64_t size = power_of_two_from(batch_ + 1);
    mask_ = size - 1;
    slots_.resize(size);
    nodes_.resize(size);
    if (drive_ != nullptr) min_seconds_ = drive_->min_seconds(), late_seconds_ = drive_->late_seconds();
    for (std::size_t i = 0; i < limits.size(); ++i)
        half_pulse_[i] = limits[i].pulses_per_unit > 0 ? 0.5 / limits[i].pulses_per_unit : 1e9;
}

Result<void> LookAheadPlanner::push(const Move& move) {
    MOTIONRACK_ASSERT(has_room());
    MOTIONRACK_TRY(const Geometry path, checked_path(move, position_, limits_));
    if (move.kind == MoveKind::dwell) {
        append_dwell(move);
        return {};
    }
    if (path.shape == PathShape::nothing) return {};

    if (!std::exchange(apart_, false) && merge(move, path)) return {};
    const AlongPathLimits along = along_of(path, move);
    double junction = 0;
    if (tail_ != ready_) {
        junction = junction_velocity2(last_, path, along);
        if (junction == 0) flush();
    }
    append(move, path, along, junction);
    if (tail_ - ready_ >= batch_) {
        backward();
        forward(std::max(ready_ + chunk_, settled_));
    }
    return {};
}

/// Returns the limits along a move, with a velocity that respects the minimum duration of the hardware.
AlongPathLimits LookAheadPlanner::along_of(const Geometry& path, const Move& move) const {
    AlongPathLimits along = limits_.along(path, move);
    if (drive_ != nullptr) along.velocity = std::min(along.velocity, drive_->max_velocity(path));
    return along;
}

/// Returns the square of the junction velocity.
double LookAheadPlanner::junction_velocity2(const Last& before, const Geometry& path,
                                            const AlongPathLimits& along) const {
    const double junction = limits_.max_junction_velocity2(before.path, before.along.velocity, path, along.velocity,
                                                           before.control, before.tolerance_mm);
    if (junction <= 0 || drive_ == nullptr) return junction;
    const double velocity = drive_->max_junction_velocity(before.path, path);
    return std::min(junction, velocity * velocity);
}

/// Returns the factor on velocity2 at a junction. The hardware's pulse rate continues through the junction of two
/// lines, and may stand for a higher velocity behind it: from line to line of a curve, and at a corner or behind an arc
/// where more axes move on. Part of the deceleration of the move before makes up for that. At a corner the hardware is
/// asked for the lesser rate, so that the plan need not show it. An arc may begin with a higher rate than its own,
/// which it must decelerate from as well.
LookAheadPlanner::Gain LookAheadPlanner::gain_of(const Last& before, const Geometry& path) const {
    constexpr double min_cosine = 0.98;
    if (drive_ == nullptr) return {};
    if (path.shape == PathShape::arc) {
        const double ratio = drive_->velocity_ratio(before.path, path);
        return {1, false, std::max(1.0, ratio * ratio)};
    }
    if (path.shape != PathShape::line || before.path.shape == PathShape::nothing) return {};
    double cosine = 0;
    for (std::size_t i = 0; i < 3; ++i) cosine += before.path.tangent_out[i] * path.tangent_in[i];
    const double ratio = drive_->velocity_ratio(before.path, path);
    return {std::max(1.0, ratio * ratio), cosine < min_cosine, 1};
}

LookAheadPlanner::Node LookAheadPlanner::node_of(const Geometry& path, const AlongPathLimits& along, double junction,
                                                 const Gain& gain) const {
    const double usable = path.length - (drive_ != nullptr ? drive_->constant_velocity_length(path) : 0);
    return {junction, 2 * along.accel * usable, along.velocity * along.velocity, 0, gain, along.accel * late_seconds_};
}

/// Returns the velocity2 from which a move can decelerate to the square `exit`: v^2 + 2 lag v = exit + reach.
double LookAheadPlanner::braked(const Node& node, double exit) {
    if (node.lag == 0) return exit + node.reach;
    const double velocity = std::sqrt(node.lag * node.lag + exit + node.reach) - node.lag;
    return velocity * velocity;
}

/// Returns the lowest velocity2 at the end of a move that begins with the square `entry`.
double LookAheadPlanner::min_exit(const Node& node, double entry) {
    return node.lag == 0 ? entry - node.reach : entry - std::max(0.0, node.reach - 2 * node.lag * std::sqrt(entry));
}

namespace {

/// Returns true for straight moves that may be merged: equal except for the corner between them.
bool are_alike(const Move& a, const Move& b) {
    const auto straight = [](const Move& move) { return move.kind == MoveKind::feed || move.kind == MoveKind::rapid; };
    return straight(a) && a.kind == b.kind && a.path == b.path && a.path != PathControl::exact_stop &&
           a.tolerance_mm == b.tolerance_mm && a.feed_mode == FeedMode::units_per_second &&
           a.feed_mode == b.feed_mode && a.feed == b.feed && a.rapid_override == b.rapid_override;
}

}  // namespace

/// Returns true if the junctions inside the merged line are within tolerance and in order along it.
bool LookAheadPlanner::is_on_the_way(const Geometry& line, double tolerance_mm) const {
    double squared = 0, reached = 0;
    Point delta = {};
    for (std::size_t i = 0; i < delta.size(); ++i) {
        delta[i] = line.end[i] - line.start[i];
        squared += delta[i] * delta[i];
    }
    for (std::size_t k = 0; k <= between_size_; ++k) {
        const Point& position = k < between_size_ ? between_[k] : position_;
        double along = 0, off = 0;
        for (std::size_t i = 0; i < delta.size(); ++i) along += (position[i] - line.start[i]) * delta[i];
        along /= squared;
        if (along <= reached || along >= 1) return false;
        reached = along;
        for (std::size_t i = 0; i < delta.size(); ++i) {
            const double beside = position[i] - line.start[i] - along * delta[i];
            if (i < 3)
                off += beside * beside;
            else if (std::fabs(beside) > half_pulse_[i])
                return false;
        }
        if (off > tolerance_mm * tolerance_mm) return false;
    }
    return true;
}

/// Returns the length of a straight move that takes the minimum duration of the hardware at its velocity and can mostly
/// be used for changing the velocity.
double LookAheadPlanner::min_length(const Geometry& path, const Move& move) const {
    constexpr double spent_lengths = 12;
    return std::max(limits_.along(path, move).velocity * min_seconds_,
                    spent_lengths * drive_->constant_velocity_length(path));
}

/// Extends the last line by a straight move. The line must be too short for the hardware at its velocity, and no final
/// entry velocity may depend on it.
bool LookAheadPlanner::merge(const Move& move, const Geometry& path) {
    constexpr double part_of_tolerance = 0.25;
    if (min_seconds_ <= 0 || tail_ == ready_ || between_size_ == max_between) return false;
    const std::uint64_t index = tail_ - 1;
    PlannedMove& last = slot(index);
    if (!are_alike(last.move, move) || (index == ready_ ? committed_ != 0 : index <= settled_)) return false;
    if (last_.path.length >= min_length(last_.path, last.move)) return false;
    if (junction_velocity2(last_, path, along_of(path, move)) <= 0) return false;
    Move whole = last.move;
    whole.end = move.end;
    const Geometry line = geometry_of(whole, last.start);
    double tolerance = std::min({half_pulse_[0], half_pulse_[1], half_pulse_[2]});
    if (move.path == PathControl::continuous) tolerance = std::max(tolerance, part_of_tolerance * move.tolerance_mm);
    if (line.shape != last_.path.shape || !is_on_the_way(line, tolerance)) return false;
    const AlongPathLimits along = along_of(line, whole);
    const double junction = index == ready_ ? node(index).junction : junction_velocity2(before_last_, line, along);
    if (index != ready_ && junction <= 0) return false;
    between_[between_size_++] = position_;
    last.move = whole;
    last.length = line.length;
    last.accel = along.accel;
    last.jerk = along.jerk;
    ++last.moves;
    ++pushed_;
    const Gain gain = index == ready_ ? Gain{} : gain_of(before_last_, line);
    node(index) = node_of(line, along, junction, gain);
    position_ = move.end;
    last_.path = line;
    last_.along = along;
    return true;
}

void LookAheadPlanner::append_dwell(const Move& move) {
    flush();
    PlannedMove& planned = slot(tail_);
    planned = PlannedMove{};
    planned.move = move;
    planned.move.end = position_;
    planned.start = position_;
    planned.number = pushed_++;
    node(tail_) = {0, 0, 0, 0, {}, 0};
    ready_ = settled_ = ++tail_;
}

void LookAheadPlanner::append(const Move& move, const Geometry& path, const AlongPathLimits& along, double junction) {
    PlannedMove& planned = slot(tail_);
    planned.move = move;
    planned.start = position_;
    planned.number = pushed_++;
    planned.moves = 1;
    planned.length = path.length;
    planned.accel = along.accel;
    planned.jerk = along.jerk;
    const Gain gain = tail_ == ready_ ? Gain{} : gain_of(last_, path);
    node(tail_) = node_of(path, along, junction, gain);
    ++tail_;
    position_ = move.end;
    before_last_ = last_;
    last_ = {path, along, move.path, move.tolerance_mm};
    between_size_ = 0;
}

void LookAheadPlanner::flush() {
    backward();
    forward(tail_);
}

/// Backward pass: from standstill at the end of the window to the first move whose entry velocity cannot change.
void LookAheadPlanner::backward() {
    const std::uint64_t last_settled = settled_;
    double entry = 0;
    for (std::uint64_t i = tail_; i > last_settled + 1;) {
        Node& here = node(--i);
        const double from = braked(here, entry) / here.gain.braking;
        if (here.junction <= from && settled_ == last_settled) settled_ = i;
        here.entry = std::min(here.junction, from);
        entry = here.entry / here.gain.square;
    }
}

/// Returns the highest velocity2 on a move. `ends`: sum of the squares at its two ends.
double LookAheadPlanner::top_of(const Node& node, double ends, const PlannedMove& planned) {
    const double top = std::min(node.cruise, 0.5 * (ends + node.reach));
    // From standstill to standstill within the constant-velocity length of the hardware: a pulse or two.
    return top > 0 ? top : std::min(node.cruise, planned.accel * planned.length);
}

/// Forward pass: makes the moves before `until` ready.
void LookAheadPlanner::forward(std::uint64_t until) {
    for (; ready_ < until; ++ready_) {
        const Node& here = node(ready_);
        const bool last = ready_ + 1 == tail_;
        const double gain = last ? 1 : node(ready_ + 1).gain.planned();
        const double after = last ? 0 : node(ready_ + 1).entry / gain;
        const double entry = committed_ * committed_;
        PlannedMove& planned = slot(ready_);
        double exit = std::min(after, entry + here.reach);
        // After change_feeds() a junction may need a lower velocity than the move can decelerate to.
        if (const double min_velocity = min_exit(here, entry * here.gain.braking);
            min_velocity - exit > path_rounding * entry)
            exit = min_velocity;
        const double top = top_of(here, entry + exit, planned);
        planned.entry_velocity = committed_;
        planned.exit_velocity = std::sqrt(exit);
        planned.cruise_velocity = std::max({std::sqrt(top), planned.entry_velocity, planned.exit_velocity});
        if (planned.entry_velocity != 0 || planned.exit_velocity != 0) planned.jerk = 0;
        committed_ = gain == 1 ? planned.exit_velocity : planned.exit_velocity * std::sqrt(gain);
    }
    settled_ = std::max(settled_, ready_);
}

bool LookAheadPlanner::pull(PlannedMove& planned) {
    if (head_ == ready_) return false;
    planned = slot(head_++);
    return true;
}

bool LookAheadPlanner::pull_early(PlannedMove& planned) {
    if (head_ == ready_ && ready_ != tail_) {
        backward();
        forward(ready_ + 1);
    }
    return pull(planned);
}

bool LookAheadPlanner::is_from_rest_to_rest(std::size_t count, bool path_ends) const {
    if (count == 0 || count > size()) return false;
    if ((head_ == ready_ ? committed_ : slot(head_).entry_velocity) != 0) return false;
    const std::uint64_t end = head_ + count;
    for (std::uint64_t i = head_; i < end; ++i)
        if (slot(i).moves != 1) return false;
    return end == tail_ ? path_ends : nodes_[end & mask_].junction == 0;
}

void LookAheadPlanner::pull_as_one(std::size_t count, PlannedMove& planned) {
    const PlannedMove& first = slot(head_);
    planned = PlannedMove{};
    planned.move = slot(head_ + count - 1).move;
    planned.start = first.start;
    planned.number = first.number;
    planned.moves = static_cast<std::int32_t>(count);
    const Geometry path = geometry_of(planned.move, planned.start);
    const AlongPathLimits along = along_of(path, planned.move);
    planned.length = path.length;
    planned.accel = along.accel;
    planned.jerk = along.jerk;
    const Node whole = node_of(path, along, 0, {});
    planned.cruise_velocity = std::sqrt(top_of(whole, 0, planned));
    head_ += count;
    if (ready_ >= head_) return;
    ready_ = head_;
    settled_ = std::max(settled_, ready_);
    committed_ = 0;
}

void LookAheadPlanner::change_feeds(const std::function<void(PlannedMove&)>& change) {
    if (head_ == tail_) return;
    if (head_ != ready_) committed_ = slot(head_).entry_velocity;
    ready_ = settled_ = head_;
    Last before;
    for (std::uint64_t i = head_; i < tail_; ++i) {
        PlannedMove& planned = slot(i);
        change(planned);
        if (planned.move.kind == MoveKind::dwell) continue;
        const Geometry path = geometry_of(planned.move, planned.start);
        const AlongPathLimits along = along_of(path, planned.move);
        planned.accel = along.accel;
        planned.jerk = along.jerk;
        const double junction = i != head_ && node(i).junction > 0 ? junction_velocity2(before, path, along) : 0;
        node(i) = node_of(path, along, junction, node(i).gain);
        before_last_ = std::exchange(before, {path, along, planned.move.path, planned.move.tolerance_mm});
    }
    last_ = before;
}

double seconds_of(const PlannedMove& planned) {
    if (planned.move.kind == MoveKind::dwell) return planned.move.seconds;
    if (planned.jerk > 0)
        return SCurveProfile(planned.length, planned.cruise_velocity, planned.accel, planned.jerk).duration();
    return TrapezoidalProfile(planned.length, planned.entry_velocity, planned.exit_velocity, planned.cruise_velocity,
                              planned.accel)
        .duration();
}

void PlanSummary::add(const PlannedMove& planned) {
    seconds += seconds_of(planned);
    if (planned.move.kind == MoveKind::dwell) {
        ++dwells;
        return;
    }
    moves += planned.moves;
    if (planned.exit_velocity == 0) ++stops;
    const bool linear = planned.start[0] != planned.move.end[0] || planned.start[1] != planned.move.end[1] ||
                        planned.start[2] != planned.move.end[2] || planned.move.kind == MoveKind::arc;
    if (!linear) return;
    path_mm += planned.length;
    peak_velocity = std::max(peak_velocity, planned.cruise_velocity);
}

}  // namespace motionrack::control
