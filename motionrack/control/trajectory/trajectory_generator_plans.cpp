// Plans that continue a motion: longer, slower, to a stop.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/trajectory/subdivide.hpp>
#include <motionrack/control/trajectory/trajectory_generator.hpp>

namespace motionrack::control {

namespace {

/// Number of bisections, and of steps outwards, in the search for a stop.
constexpr int halvings = 5, steps_out = 40;
/// Share of the velocity at which the first try evaluates the deceleration limit.
constexpr double part_of_velocity = 0.7;
/// Velocity limit on curves during a stop, relative to the current plan: acceleration that a higher velocity does not
/// need remains for deceleration.
constexpr double above_plan = 1.003;
/// As above_plan, for a motion whose acceleration makes it exceed the velocities of its plan: only the limits for which
/// the plan was made apply.
constexpr double above_any = 1e9;
/// A change to lower feed rates may exceed the velocity of a stop by the factor `faster` and its duration by
/// `max_ease`. After a failure the allowed duration grows by `ease_grows`.
constexpr double faster = 1.01, max_ease = 16, ease_grows = 1.3;
/// A velocity below this share of another one is lower, not only rounded.
constexpr double clearly_slower = 0.99;

InitialPathState start_of(const PathMotion& along) {
    return {along.velocity * along.velocity, 2 * along.accel};
}

/// Finds a stop within the velocities of the current plan, or else within the limits for which it was made.
template <class Find>
std::optional<double> nearest_stop(Find find) {
    const std::optional<double> end = find(above_plan);
    return end ? end : find(above_any);
}

/// Returns true if the profile accelerates after it has decelerated.
bool accelerates_again(std::span<const ProfileSegment> feed) {
    double peak_velocity = 0, min_velocity = std::numeric_limits<double>::infinity();  // the last since it decelerates
    for (const ProfileSegment& piece : feed) {
        const double velocity = piece.last().velocity;
        peak_velocity = std::max({peak_velocity, piece.at(0).velocity, velocity});
        if (velocity < clearly_slower * peak_velocity) min_velocity = std::min(min_velocity, velocity);
        if (clearly_slower * velocity > min_velocity) return true;
    }
    return false;
}

}  // namespace

/// Takes over the plan just found from a point that is reached in `seconds`. Until then the previous plan applies.
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

/// Computes the duration of the plan and the start of its final deceleration.
void TrajectoryGenerator::measure() {
    left_ = -on_feed_;
    braking_ = 0;
    for (const ProfileSegment& piece : now_.feed) {
        left_ += piece.seconds;
        braking_ = slows(piece) ? braking_ + piece.seconds : 0;
    }
}

/// Plans from a motion on this segment to standstill at the end of the known path.
bool TrajectoryGenerator::plan_to_end(std::size_t piece, const PathMotion& along) {
    const auto first = static_cast<std::ptrdiff_t>(piece);
    return planner_.plan(start_of(along), {now_.curve.begin() + first, now_.curve.end()},
                         {now_.use.begin() + first, now_.use.end()}, along.u, now_.known());
}

/// Extends the plan to the end of the known path. Keeps the findings for segments before the old deceleration; those of
/// the other segments are unknown.
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
    const std::optional<double> end = nearest_stop([&](double above) { return find_stop(from, above); });
    if (!end) return false;
    holding_ = true;
    take(from, before_left_, *end);
    return true;
}

/// Finds the nearest possible stop; the plan to it is the planner's last one. `above`: velocity limit on curves,
/// relative to the current plan.
std::optional<double> TrajectoryGenerator::find_stop(const PlanCursor& from, double above) {
    const InitialPathState start = start_of(from.along);
    const double begin = from.along.u, max_distance = now_.planned_to - begin;
    double planned = -1;  // end of the planner's last plan; below 0: no plan
    std::vector<SegmentTuning> use;
    std::size_t k = feed_;
    // A stop overrules a deceleration to lower feed rates, so those need not be observed on its way.
    const double feed = now_.curve[from.piece].feed, eases_from = feed > feed_of(now_, from.piece) ? feed : 0;
    stop_curve_.clear();
    const auto add_piece = [&](std::size_t i) {
        stop_curve_.push_back(now_.curve[i]);
        stop_curve_.back().feed = std::max(now_.curve[i].feed, std::min(eases_from, now_.programmed[i]));
        use.push_back(now_.use_for_stop(i, k, eases_from > 0 ? from.along.velocity : 0, above));
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
    const LimitInterval interval =
        SegmentLimits(now_.curve[from.piece], limits_).up_to(part_of_velocity * from.along.velocity, 0);
    double distance =
               0.25 * from.along.velocity * (from.along.velocity / interval.brake + interval.brake / interval.jerk),
           too_near = 0;
    for (int i = 0; i < steps_out && distance < max_distance && !plan_to(distance); ++i) {
        too_near = distance;
        distance *= 1.5;
    }
    if (distance >= max_distance) return std::nullopt;
    for (int i = 0; i < halvings; ++i) {
        const double nearer = 0.5 * (too_near + distance);
        (plan_to(nearer) ? distance : too_near) = nearer;
    }
    if (planned != distance && !plan_to(distance)) return std::nullopt;
    // Behind a slow passage a stop is found when the motion is nearer to it.
    if (accelerates_again(planner_.feed())) return std::nullopt;
    return begin + distance;
}

/// Applies new feed rates. Where the motion exceeds them, allows the velocities of a stop.
bool TrajectoryGenerator::apply_overrides() {
    const PlanCursor from = spot_at(before_left_);
    const bool slower = std::min(feed_override_, rapid_override_) < 1;
    std::vector<ProfileSegment> stop;
    if (slower) {
        if (!nearest_stop([&](double above) { return find_stop(from, above); })) return false;
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

/// Returns the known path from a point on, with the current feed rates. Divides the segments on the way of a stop,
/// stretched by ease_, where its velocity changes. Each may have the velocity there; up to the fastest point, the
/// maximum.
KnownSection TrajectoryGenerator::with_feeds(const PlanCursor& from, std::span<const ProfileSegment> stop) const {
    KnownSection out;
    double at = from.along.u;
    std::size_t i = from.piece;
    const auto end_of = [&] { return now_.curve[i].begin + now_.curve[i].length; };
    const auto add = [&](double to, double velocity) {
        out.curve.push_back(sub_move(now_.curve[i], at - now_.curve[i].begin, to - now_.curve[i].begin));
        out.programmed.push_back(now_.programmed[i]);
        out.use.emplace_back();
        set_feed(out, out.curve.size() - 1, velocity);
        if (velocity > 0) out.use.back().jerk_share = now_.use[i].jerk_share;
        at = to;
    };
    const auto slower = [](const ProfileSegment& a, const ProfileSegment& b) {
        return a.at(0).velocity < b.at(0).velocity;
    };
    const auto peak_index = static_cast<std::size_t>(std::max_element(stop.begin(), stop.end(), slower) - stop.begin());
    for (std::size_t k = 0; k < stop.size(); ++k) {
        const double velocity = faster * stop[std::max(k, peak_index)].at(0).velocity,
                     to = from.along.u + ease_ * (stop[k].begin + stop[k].length - from.along.u);
        for (; i + 1 < now_.curve.size() && end_of() <= to; ++i)
            if (end_of() > at) add(end_of(), velocity);
        if (to > at && to < end_of()) add(to, velocity);
    }
    for (; i < now_.curve.size(); ++i)
        if (end_of() > at) add(end_of(), 0);
    return out;
}

}  // namespace motionrack::control
