#include <motionrack/control/ride/stretch_planner.hpp>

#include <algorithm>
#include <motionrack/control/ride/limits_on.hpp>

namespace motionrack::control {

namespace {

/// Rounds of planning, and the part of the time that must be won for another one.
constexpr int most_rounds = 4;
constexpr double worth_another = 0.995;
/// So much faster than found last it may become.
constexpr double slack = 1.25;

}  // namespace

/// What a bend leaves for changing the speed depends on the speed: where that turns out to be slower than it might be, there is more.
bool StretchPlanner::plan(const FeedStart& start, std::span<const CurvePiece> curve, std::span<FeedSpan> spans, double from, double to) {
    feed_.clear();
    seconds_ = 0;
    if (curve.empty() || !(to > from)) return false;
    spans_.assign(spans.begin(), spans.end());
    for (std::size_t i = 0; i < curve.size(); ++i) spans_[i].length = std::min(to, curve[i].begin + curve[i].length) - std::max(from, curve[i].begin);
    for (int round = 0; round < most_rounds; ++round) {
        const std::span<const FeedPiece> found = planner_.plan_from(start, spans_);
        double seconds = 0;
        for (const FeedPiece& piece : found) seconds += piece.seconds;
        const bool much = seconds < worth_another * seconds_;
        if (!found.empty() && (feed_.empty() || seconds < seconds_)) {
            feed_.assign(found.begin(), found.end());
            for (FeedPiece& piece : feed_) piece.begin += from;
            seconds_ = seconds;
            for (std::size_t i = 0; i < spans.size(); ++i) spans[i] = {curve[i].length, spans_[i].speed, spans_[i].accel, spans_[i].jerk};
        }
        if (feed_.empty() || (round > 0 && !much) || !narrow(curve)) break;
    }
    return !feed_.empty();
}

/// False: all is driven nearly as fast as was allowed.
bool StretchPlanner::narrow(std::span<const CurvePiece> curve) {
    bool news = false;
    std::size_t k = 0;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const double end = curve[i].begin + curve[i].length;
        double fastest = 0;
        for (;; ++k) {
            fastest = std::max({fastest, feed_[k].at(0).speed, feed_[k].at(feed_[k].seconds).speed});
            if (k + 1 == feed_.size() || feed_[k].begin + feed_[k].length >= end) break;
        }
        if (fastest * slack >= spans_[i].speed || is_straight(curve[i])) continue;
        const double length = spans_[i].length;
        spans_[i] = limits_on(curve[i], limits_, fastest * slack);
        spans_[i].length = length;
        news = true;
    }
    return news;
}

}  // namespace motionrack::control
