// Moves to segments to plans, and the motion along them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/trajectory/subdivide.hpp>
#include <motionrack/control/trajectory/trajectory_generator.hpp>
#include <utility>

namespace motionrack::control {

namespace {

/// Time before deceleration starts at which a plan is extended, s: more than a caller advances at once.
constexpr double margin = 0.15;
/// Delay before planning is retried, s.
constexpr double max_wait = 0.008;
/// Passed segments are removed in batches of this size.
constexpr std::size_t min_drop = 1'024;

double max_axis_velocity(const CubicSegment& piece, const MachineLimits& limits) {
    const Point middle = tangent_on(piece, 0.5 * piece.length), end = tangent_on(piece, piece.length);
    return std::min({max_velocity_along(piece.tangent, limits), max_velocity_along(middle, limits),
                     max_velocity_along(end, limits)});
}

}  // namespace

TrajectoryGenerator::TrajectoryGenerator(const MachineLimits& limits, const Point& start,
                                         TrajectoryGeneratorSettings settings)
    : limits_(limits), settings_(settings), builder_(limits, start), planner_(limits) {}

// ---- moves and segments

void TrajectoryGenerator::push(const TrajectoryMove& move) {
    Move tagged = move.move;
    tagged.line = moves_.push(move);
    reserve();
    builder_.push(tagged);
    fetch_segments(settings_.window);
}

void TrajectoryGenerator::flush() {
    reserve();
    moves_.flush();
    builder_.flush();
    fetch_segments(settings_.window);
}

/// Makes room in the path builder. If a flush and a push coincide, a few more segments are known than the window
/// allows.
void TrajectoryGenerator::reserve() {
    if (!builder_.has_room()) fetch_segments(std::numeric_limits<std::size_t>::max());
}

std::int64_t TrajectoryGenerator::first_pending_move() const {
    if (left_ > 0 || position_ < now_.known()) return moves_.number_of(now_.curve[piece_].line);
    if (now_.whole && dwell_seconds() > 0) return move_of_rest();
    if (now_.whole && !then_.curve.empty()) return moves_.number_of(then_.curve.front().line);
    return moves_.first_in_builder();
}

void TrajectoryGenerator::fetch_segments(std::size_t max_segments) {
    for (;;) {
        KnownSection& part = now_.whole ? then_ : now_;
        if (part.whole || part.curve.size() - (now_.whole ? 0 : piece_) >= max_segments) return;
        PathElement item;
        if (!builder_.pull(item)) return;
        moves_.report(item.rest ? item.line : item.piece.line);
        if (item.rest) {
            part.whole = true;
            part.rest = item;
        } else {
            for_each_subsegment(item.piece, limits_, [&](const CubicSegment& one) {
                part.append(one);
                set_feed(part, part.curve.size() - 1);
            });
        }
    }
}

/// Returns the feed rate of a segment with the overrides.
double TrajectoryGenerator::feed_of(const KnownSection& part, std::size_t i) const {
    const double programmed = part.programmed[i];
    if (!moves_.move(moves_.number_of(part.curve[i].line)).overridable) return programmed;
    if (programmed < std::numeric_limits<double>::infinity()) return programmed * feed_override_;
    return rapid_override_ < 1 ? rapid_override_ * max_axis_velocity(part.curve[i], limits_) : programmed;
}

/// Sets the feed rate of a segment and drops the findings of earlier plans.
void TrajectoryGenerator::set_feed(KnownSection& part, std::size_t i, double at_least) const {
    part.curve[i].feed = std::max(feed_of(part, i), at_least);
    part.use[i] = {};
}

void TrajectoryGenerator::drop_passed() {
    if (piece_ < min_drop) return;
    const auto drop = [this](auto& column) {
        column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(piece_));
    };
    drop(now_.curve);
    drop(now_.programmed);
    drop(now_.use);
    piece_ = 0;
    moves_.forget_before(moves_.number_of(now_.curve.front().line));
}

void TrajectoryGenerator::advance_section() {
    moves_.forget_before(move_of_rest());
    std::swap(now_, then_);
    then_.clear();
    piece_ = feed_ = 0;
    position_ = on_feed_ = 0;
    reach_ = 0;
    holding_ = met_ = false;
    dwelt_ = 0;
    measure();
    fetch_segments(settings_.window);
}

void TrajectoryGenerator::set_overrides(double feed, double rapid) {
    if (feed == feed_override_ && rapid == rapid_override_) return;
    feed_override_ = feed;
    rapid_override_ = rapid;
    new_feeds_ = true;
    retry_delay_s_ = 0;
    cancel_overlap();
    for (std::size_t i = 0; i < then_.curve.size(); ++i) set_feed(then_, i);
}

// ---- next action

NextMotion TrajectoryGenerator::next(bool early) {
    for (fetch_segments(settings_.window);;) {
        if (left_ > 0) {
            update_plan(early);
            return NextMotion::motion;
        }
        if (held_) return NextMotion::nothing;
        if (position_ < now_.known()) {
            if (!early && !now_.is_ready(piece_, settings_.window)) return NextMotion::nothing;
            begin();
            continue;
        }
        if (!now_.whole) return NextMotion::nothing;
        if (dwell_seconds() > 0) return NextMotion::dwell;
        advance_section();
    }
}

/// Starts from standstill, anywhere on the section.
void TrajectoryGenerator::begin() {
    piece_ = now_.piece_at(position_, piece_);
    drop_passed();
    holding_ = new_feeds_ = false;
    for (std::size_t i = piece_; i < now_.curve.size(); ++i) set_feed(now_, i);
    PlanCursor here;
    here.piece = piece_;
    here.along.u = position_;
    plan_to_end(here.piece, here.along);
    take(here, 0, now_.known());
}

/// Keeps the plan ahead of the motion.
void TrajectoryGenerator::update_plan(bool early) {
    if (retry_delay_s_ <= 0) {
        bool tried = true, found = true;
        if (held_) {
            tried = !holding_, found = !tried || slow_down();
            if (!found) cancel_overlap();  // close to its end the motion stops there
        } else if (new_feeds_)
            found = apply_overrides();
        else if (holding_ || (now_.planned_to < now_.known() && left_ - braking_ <= margin))
            found = extend_plan();
        else
            tried = false;
        if (tried && !found) retry_delay_s_ = max_wait;
    }
    plan_overlap(early);
}

/// Plans an overlap: the next section may start before this one ends.
void TrajectoryGenerator::plan_overlap(bool early) {
    if (met_ || held_ || !now_.whole || now_.planned_to < now_.known() || left_ > braking_ + margin) return;
    if (then_.curve.empty() || now_.rest.seconds > 0) return;
    if (!early && !then_.is_ready(0, settings_.window)) return;
    met_ = true;
    if (!planner_.plan({}, then_.curve, then_.use, 0, then_.known())) return;
    then_.feed.assign(planner_.feed().begin(), planner_.feed().end());
    then_.planned_to = then_.known();
    reach_ = max_overlap_s(final_deceleration(now_.curve, now_.feed), initial_acceleration(then_.curve, then_.feed),
                           left_ - before_left_, now_.rest.corner_tolerance_mm, limits_);
}

/// Cancels the planned overlap with the next section.
void TrajectoryGenerator::cancel_overlap() {
    met_ = false;
    reach_ = 0;
    then_.feed.clear();
}

// ---- motion along the plan

TrajectoryGenerator::PlanCursor TrajectoryGenerator::spot_at(double seconds) const {
    PlanCursor out{feed_, piece_, on_feed_ + seconds, {}};
    while (out.feed + 1 < now_.feed.size() && out.on_feed > now_.feed[out.feed].seconds)
        out.on_feed -= now_.feed[out.feed++].seconds;
    out.along = now_.feed[out.feed].at(std::clamp(out.on_feed, 0.0, now_.feed[out.feed].seconds));
    if (seconds >= left_) out.along = {now_.planned_to, 0, out.along.accel, out.along.jerk};
    out.piece = now_.piece_at(out.along.u, out.piece);
    return out;
}

TrajectoryPoint TrajectoryGenerator::at(double seconds) const {
    const PlanCursor spot = spot_at(seconds);
    TrajectoryPoint out = trajectory_point(now_.curve[spot.piece], spot.along);
    if (now_.whole && seconds >= left_ && now_.planned_to >= now_.known()) out.position = now_.rest.at;
    if (seconds < before_left_) add_overlap(out, before_.end(), before_left_ - seconds);
    return out;
}

void TrajectoryGenerator::advance(double seconds) {
    before_left_ = std::max(0.0, before_left_ - seconds);
    retry_delay_s_ = std::max(0.0, retry_delay_s_ - seconds);
    if (seconds >= left()) {
        if (reach_ > 0) before_.keep(final_deceleration(now_.curve, now_.feed));
        before_left_ = reach_;
        if (reach_ > 0) return advance_section();
        position_ = now_.planned_to;
        piece_ = spot_at(left_).piece;
        left_ = 0;
        now_.feed.clear();
        return;
    }
    const PlanCursor spot = spot_at(seconds);
    feed_ = spot.feed;
    on_feed_ = spot.on_feed;
    piece_ = spot.piece;
    position_ = spot.along.u;
    left_ -= seconds;
    drop_passed();
}

}  // namespace motionrack::control
