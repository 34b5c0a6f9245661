#include <motionrack/control/ride/stretch_planner.hpp>

#include <algorithm>
#include <cmath>
#include <motionrack/control/ride/limits_on.hpp>

namespace motionrack::control {

namespace {

/// Rounds of planning, and the part of the time that must be won for another one.
constexpr int most_rounds = 3;
constexpr double worth_another = 0.995;
/// So much faster than found last it may become.
constexpr double first_slack = 0.35, slack_falls = 0.3;
/// What comes so near to a limit is held by it; so much more a limit must become to be worth it.
constexpr double nearly = 1.01;
/// What a piece needed for changing the speed becomes more where neighbours become quicker.
constexpr double reserve = 1.3;

}  // namespace

/// What a bend leaves for changing the speed depends on the speed: where that turns out to be slower than it might be, there is more.
bool StretchPlanner::plan(const FeedStart& start, std::span<const CurvePiece> curve, std::span<FeedSpan> spans, double from, double to) {
    feed_.clear();
    seconds_ = 0;
    if (curve.empty() || !(to > from)) return false;
    spans_.assign(spans.begin(), spans.end());
    for (std::size_t i = 0; i < curve.size(); ++i) spans_[i].length = std::min(to, curve[i].begin + curve[i].length) - std::max(from, curve[i].begin);
    double slack = 1 + first_slack;
    for (int round = 0; round < most_rounds; ++round) {
        const std::span<const FeedPiece> found = round == 0 ? planner_.sketch_from(start, spans_) : planner_.sketch_again(spans_);
        double seconds = 0;
        for (const FeedPiece& piece : found) seconds += piece.seconds;
        const bool much = seconds < worth_another * seconds_;
        if (!found.empty() && (feed_.empty() || seconds < seconds_)) {
            feed_.assign(found.begin(), found.end());
            for (FeedPiece& piece : feed_) piece.begin += from;
            seconds_ = seconds;
            for (std::size_t i = 0; i < spans.size(); ++i) spans[i] = {curve[i].length, spans_[i].speed, spans_[i].accel, spans_[i].jerk};
        }
        if (feed_.empty() || (round > 0 && !much) || !narrow(curve, slack)) break;
        slack = 1 + (slack - 1) * slack_falls;
    }
    seconds_ = 0;
    for (FeedPiece& piece : feed_) {
        settle(piece);
        seconds_ += piece.seconds;
    }
    return !feed_.empty();
}

/// Each piece by the speeds, accelerations and jerks that were found on it. False: no limit of any changes much.
bool StretchPlanner::narrow(std::span<const CurvePiece> curve, double slack) {
    bool news = false;
    std::size_t k = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const double end = curve[i].begin + curve[i].length;
        FeedState most;
        for (;; ++k) {
            for (const FeedState& state : {feed_[k].at(0), feed_[k].last()})
                most = FeedState{0, std::max(most.speed, state.speed), std::max(most.accel, std::fabs(state.accel)), std::max(most.jerk, std::fabs(state.jerk))};
            if (k + 1 == feed_.size() || feed_[k].begin + feed_[k].length >= end) break;
        }
        FeedSpan& span = spans_[i];
        if (is_straight(curve[i])) continue;
        const double length = span.length;
        FeedSpan next;
        if (most.speed * slack < span.speed) {
            next = limits_on(curve[i], limits_, most.speed * slack);
        } else if (most.speed * nearly > span.speed && most.speed * nearly < curve[i].feed) {
            next = limits_on(curve[i], limits_, no_speed_limit, shares_beside(curve[i], limits_, most.speed, reserve * most.accel, reserve * most.jerk));
            if (next.speed < nearly * span.speed) continue;
        } else {
            continue;
        }
        span = next;
        span.length = length;
        news = true;
    }
    return news;
}

}  // namespace motionrack::control
