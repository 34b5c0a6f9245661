// Plans that go on from a motion: further, slower, to a stand.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/trajectory/subdivide.hpp>
#include <motionrack/control/trajectory/trajectory_generator.hpp>

namespace motionrack::control {

namespace {

/// A stop is sought this much nearer and nearer.
constexpr int halvings = 5, steps_out = 40;
/// The first try is about as hard as one may brake at this part of the speed.
constexpr double part_of_speed = 0.7;
/// On the way of a stop a curvature need hardly be driven faster than it would be without: what is not needed for its
/// speed is left to slow down.
constexpr double above_plan = 1.003;
/// A way into lower feeds may be so much faster than a stop, and so much longer; where none is found, the next one by
/// this much more.
constexpr double faster = 1.01, max_ease = 16, ease_grows = 1.3;
/// A speed below this part of another is slower, and not only rounded.
constexpr double clearly_slower = 0.99;

InitialPathState start_of(const PathMotion& along) {
    return {along.speed * along.speed, 2 * along.accel};
}

/// Whether it becomes faster once it has slowed down.
bool speeds_up_again(std::span<const ProfileSegment> feed) {
    double greatest = 0, lowest = std::numeric_limits<double>::infinity();  // lowest: since it slows down
    for (const ProfileSegment& piece : feed) {
        const double speed = piece.last().speed;
        greatest = std::max({greatest, piece.at(0).speed, speed});
        if (speed < clearly_slower * greatest) lowest = std::min(lowest, speed);
        if (clearly_slower * speed > lowest) return true;
    }
    return false;
}

}  // namespace

/// The plan just found is driven, from a spot that is reached in `seconds`; until then the one before, which launches
/// there.
void TrajectoryGenerator::take(const PlanCursor& from, double seconds, double to) {
    if (seconds > 0) {
        now_.feed.erase(now_.feed.begin(), now_.feed.begin() + static_cast<std::ptrdiff_t>(feed_));
        now_.feed.resize(from.feed - feed_ + 1);
        ProfileSegment& last = now_.feed.back();
        last.length = from.along.u - last.begin;
        last.seconds = from.on_feed;
    } else {
        now_.feed.clear();
        on_feed_ = 0;
    }
    feed_ = 0;
    now_.feed.insert(now_.feed.end(), planner_.feed().begin(), planner_.feed().end());
    now_.planned_to = to;
    cancel_overlap();
    measure();
}

/// How long the plan lasts, and from when on it only slows down.
void TrajectoryGenerator::measure() {
    left_ = -on_feed_;
    braking_ = 0;
    for (const ProfileSegment& piece : now_.feed) {
        left_ += piece.seconds;
        braking_ = slows(piece) ? braking_ + piece.seconds : 0;
    }
}

/// From a motion on this piece to rest at the end of what is known.
bool TrajectoryGenerator::plan_to_end(std::size_t piece, const PathMotion& along) {
    const auto first = static_cast<std::ptrdiff_t>(piece);
    return planner_.plan(start_of(along), {now_.curve.begin() + first, now_.curve.end()},
                         {now_.use.begin() + first, now_.use.end()}, along.u, now_.known());
}

/// To the end of what is known. What was found for pieces before it would slow down stays; of the others it is not
/// known how fast they are.
bool TrajectoryGenerator::extend_plan() {
    const PlanCursor from = spot_at(before_left_);
    const double slows_at = spot_at(std::max(0.0, left_ - braking_)).along.u;
    for (std::size_t i = from.piece; i < now_.curve.size(); ++i)
        if (holding_ || now_.curve[i].begin + now_.curve[i].length > slows_at) set_feed(now_, i);
    if (!plan_to_end(from.piece, from.along)) return false;
    holding_ = false;
    take(from, before_left_, now_.known());
    return true;
}

bool TrajectoryGenerator::slow_down() {
    const PlanCursor from = spot_at(before_left_);
    const std::optional<double> end = find_stop(from);
    if (!end) return false;
    holding_ = true;
    take(from, before_left_, *end);
    return true;
}

/// What is known of a piece, for a stop on it, that is driven as fast as is planned, or as fast as `planned`; `k`: the
/// first part of the feed that is looked at, then the first that reaches there.
SegmentTuning TrajectoryGenerator::use_for_stop(std::size_t piece, std::size_t& k, double planned) const {
    const CubicSegment& on = now_.curve[piece];
    SegmentTuning use = now_.use[piece];
    if (is_straight(on)) return use;
    while (k + 1 < now_.feed.size() && now_.feed[k + 1].begin <= on.begin) ++k;
    for (std::size_t i = k; i < now_.feed.size() && now_.feed[i].begin < on.begin + on.length; ++i)
        planned = std::max({planned, now_.feed[i].at(0).speed, now_.feed[i].last().speed});
    use.speed = std::min(use.speed, above_plan * planned);
    return use;
}

/// The nearest place to stand at that is found: a plan to it is the planner's last.
std::optional<double> TrajectoryGenerator::find_stop(const PlanCursor& from) {
    const InitialPathState start = start_of(from.along);
    const double begin = from.along.u, most = now_.planned_to - begin;
    double planned = -1;  // how far the planner's last plan goes; below 0: it found none
    std::vector<SegmentTuning> use;
    std::size_t k = feed_;
    // Where it slows down for lower feeds, it slows down more for a stop: they need not be kept on its way.
    const double feed = now_.curve[from.piece].feed, eases_from = feed > feed_of(now_, from.piece) ? feed : 0;
    stop_curve_.clear();
    const auto add_piece = [&](std::size_t i) {
        stop_curve_.push_back(now_.curve[i]);
        stop_curve_.back().feed = std::max(now_.curve[i].feed, std::min(eases_from, now_.programmed[i]));
        use.push_back(use_for_stop(i, k, eases_from > 0 ? from.along.speed : 0));
    };
    const auto plan_to = [&](double distance) {
        std::size_t last = from.piece;
        while (last + 1 < now_.curve.size() && now_.curve[last + 1].begin < begin + distance) ++last;
        const std::size_t pieces = last + 1 - from.piece;
        while (use.size() < pieces) add_piece(from.piece + use.size());
        stop_use_.assign(use.begin(), use.begin() + static_cast<std::ptrdiff_t>(pieces));
        const bool found = planner_.plan(start, {stop_curve_.data(), pieces}, stop_use_, begin, begin + distance);
        planned = found ? distance : -1;
        return found;
    };
    const LimitInterval span =
        SegmentLimits(now_.curve[from.piece], limits_).up_to(part_of_speed * from.along.speed, 0);
    double distance = 0.25 * from.along.speed * (from.along.speed / span.brake + span.brake / span.jerk), too_near = 0;
    for (int i = 0; i < steps_out && distance < most && !plan_to(distance); ++i) {
        too_near = distance;
        distance *= 1.5;
    }
    if (distance >= most) return std::nullopt;
    for (int i = 0; i < halvings; ++i) {
        const double nearer = 0.5 * (too_near + distance);
        (plan_to(nearer) ? distance : too_near) = nearer;
    }
    if (planned != distance && !plan_to(distance)) return std::nullopt;
    // Behind a narrow place that it passes as slowly anyway a stop is found when it is nearer.
    if (speeds_up_again(planner_.feed())) return std::nullopt;
    return begin + distance;
}

/// With other feeds. Where the motion is faster than they allow, it may be as fast as if it slowed down to stand.
bool TrajectoryGenerator::apply_overrides() {
    const PlanCursor from = spot_at(before_left_);
    const bool slower = std::min(feed_override_, rapid_override_) < 1;
    std::vector<ProfileSegment> stop;
    if (slower) {
        if (!find_stop(from)) return false;
        stop.assign(planner_.feed().begin(), planner_.feed().end());
    }
    KnownSection part = with_feeds(from, stop);
    if (!planner_.plan(start_of(from.along), part.curve, part.use, from.along.u, now_.known())) {
        ease_ = std::min(ease_grows * ease_, max_ease);
        return false;
    }
    const auto replace = [&](auto& column, const auto& by) {
        column.resize(from.piece + 1);
        column.insert(column.end(), by.begin(), by.end());
    };
    CubicSegment& passed = now_.curve[from.piece];
    passed.length = from.along.u - passed.begin;
    replace(now_.curve, part.curve);
    replace(now_.programmed, part.programmed);
    replace(now_.use, part.use);
    new_feeds_ = holding_ = false;
    ease_ = min_ease;
    take(from, before_left_, now_.known());
    return true;
}

/// What is known from a spot on, with the present feeds. The pieces on the way of a stop, drawn out by ease_, are cut
/// where it changes, and each may be as fast as it is there; up to where the stop is fastest, as fast as that.
TrajectoryGenerator::KnownSection TrajectoryGenerator::with_feeds(const PlanCursor& from,
                                                                  std::span<const ProfileSegment> stop) const {
    KnownSection out;
    double at = from.along.u;
    std::size_t i = from.piece;
    const auto end_of = [&] { return now_.curve[i].begin + now_.curve[i].length; };
    const auto add = [&](double to, double speed) {
        out.curve.push_back(sub_move(now_.curve[i], at - now_.curve[i].begin, to - now_.curve[i].begin));
        out.programmed.push_back(now_.programmed[i]);
        out.use.emplace_back();
        set_feed(out, out.curve.size() - 1, speed);
        if (speed > 0) out.use.back().jerk_share = now_.use[i].jerk_share;
        at = to;
    };
    const auto slower = [](const ProfileSegment& a, const ProfileSegment& b) { return a.at(0).speed < b.at(0).speed; };
    const auto fastest = static_cast<std::size_t>(std::max_element(stop.begin(), stop.end(), slower) - stop.begin());
    for (std::size_t k = 0; k < stop.size(); ++k) {
        const double speed = faster * stop[std::max(k, fastest)].at(0).speed,
                     to = from.along.u + ease_ * (stop[k].begin + stop[k].length - from.along.u);
        for (; i + 1 < now_.curve.size() && end_of() <= to; ++i)
            if (end_of() > at) add(end_of(), speed);
        if (to > at && to < end_of()) add(to, speed);
    }
    for (; i < now_.curve.size(); ++i)
        if (end_of() > at) add(end_of(), 0);
    return out;
}

}  // namespace motionrack::control
