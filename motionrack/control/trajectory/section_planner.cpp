#include <algorithm>
#include <cmath>
#include <motionrack/control/trajectory/section_planner.hpp>

namespace motionrack::control {

namespace {

/// Maximum number of planning rounds, and the relative gain that justifies another one.
constexpr int max_rounds = 3;
constexpr double worth_another = 0.995;
/// Allowed relative increase over the last velocity found.
constexpr double first_slack = 0.35, slack_falls = 0.3;
/// A limit is active within this factor; a change below it is not worth replanning.
constexpr double nearly = 1.01;
/// Margin on the acceleration that a segment needed, because it needs more if its neighbours become faster.
constexpr double reserve = 1.3;

}  // namespace

bool SectionPlanner::plan(const InitialPathState& start, std::span<const CubicSegment> curve,
                          std::span<SegmentTuning> use, double from, double to) {
    feed_.clear();
    seconds_ = 0;
    if (curve.empty() || !(to > from)) return false;
    measure(curve, use, from, to);
    compute_reachable_velocities(start);
    double slack = 1 + first_slack;
    for (int round = 0; round < max_rounds; ++round) {
        const std::span<const ProfileSegment> found =
            round == 0 ? planner_.plan_approximate(start, spans_) : planner_.replan_approximate(spans_);
        double seconds = 0;
        for (const ProfileSegment& piece : found) seconds += piece.seconds;
        const bool much = seconds < worth_another * seconds_;
        if (!found.empty() && (feed_.empty() || seconds < seconds_)) {
            feed_.assign(found.begin(), found.end());
            seconds_ = seconds;
            std::copy(use_.begin(), use_.end(), use.begin());
        }
        if (feed_.empty() || (round > 0 && !much) || !tighten_limits(slack)) break;
        compute_reachable_velocities(start);
        slack = 1 + (slack - 1) * slack_falls;
    }
    seconds_ = 0;
    for (ProfileSegment& piece : feed_) {
        piece.begin += from;
        settle(piece);
        seconds_ += piece.seconds;
    }
    return !feed_.empty();
}

void SectionPlanner::measure(std::span<const CubicSegment> curve, std::span<const SegmentTuning> use, double from,
                             double to) {
    pieces_.clear();
    spans_.clear();
    use_.assign(use.begin(), use.end());
    for (const CubicSegment& piece : curve) {
        pieces_.emplace_back(piece, limits_);
        spans_.push_back({std::min(to, piece.begin + piece.length) - std::max(from, piece.begin)});
    }
}

/// Computes the highest velocity of each segment, and the acceleration that remains for changing it.
void SectionPlanner::compute_reachable_velocities(const InitialPathState& start) {
    const std::size_t n = pieces_.size();
    squares_.assign(n + 1, 0);
    max_velocities_.resize(n);
    for (std::size_t i = 0; i < n; ++i)
        max_velocities_[i] = std::min(use_[i].velocity, pieces_[i].max_velocity_for(use_[i].jerk_share));
    for (std::size_t i = n; i-- > 0;) {
        const double max_velocity = std::min(max_velocities_[i], max_velocities_[i == 0 ? 0 : i - 1]);
        squares_[i] =
            std::min(max_velocity * max_velocity, pieces_[i].velocity2_before(squares_[i + 1], spans_[i].length));
    }
    squares_[0] = start.velocity2;
    for (std::size_t i = 0; i < n; ++i) {
        const double length = spans_[i].length, up = pieces_[i].velocity2_after(squares_[i], length);
        squares_[i + 1] = std::min(squares_[i + 1], up);
        spans_[i] =
            pieces_[i].up_to(pieces_[i].straight ? max_velocities_[i]
                                                 : std::min(max_velocities_[i], std::sqrt(max_segment_velocity(i, up))),
                             length);
    }
}

/// Returns the velocity2 where acceleration from the start, reaching `up` at the end, meets deceleration to the end.
double SectionPlanner::max_segment_velocity(std::size_t i, double up) const {
    const double begin = squares_[i], end = squares_[i + 1], down = pieces_[i].velocity2_before(end, spans_[i].length);
    const double rise = up - begin, fall = down - end;
    return rise + fall > 0 ? begin + rise * std::clamp((down - begin) / (rise + fall), 0.0, 1.0) : std::max(begin, end);
}

/// Returns the maximum found up to `end`; `k`: the first profile segment to inspect, then the last one.
PathMotion SectionPlanner::max_found(double end, std::size_t& k) const {
    PathMotion peak;
    for (;; ++k) {
        for (const PathMotion& state : {feed_[k].at(0), feed_[k].last()})
            peak = PathMotion{0, std::max(peak.velocity, state.velocity), std::max(peak.accel, std::fabs(state.accel)),
                              std::max(peak.jerk, std::fabs(state.jerk))};
        if (k + 1 == feed_.size() || feed_[k].begin + feed_[k].length >= end) return peak;
    }
}

/// Limits each segment to a little above the velocity found, and gives curves that the jerk limits a larger share of
/// it. Returns false if no limit changed.
bool SectionPlanner::tighten_limits(double slack) {
    bool changed = false;
    std::size_t k = 0;
    double end = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        end += spans_[i].length;
        const PathMotion peak = max_found(end, k);
        if (pieces_[i].straight) continue;
        if (peak.velocity * slack < spans_[i].velocity) {
            use_[i].velocity = peak.velocity * slack;
            changed = true;
        } else if (peak.velocity * nearly > max_velocities_[i]) {
            const double share = pieces_[i].jerk_share_beside(peak.velocity, reserve * peak.accel, reserve * peak.jerk);
            if (pieces_[i].max_velocity_for(share) < nearly * max_velocities_[i]) continue;
            use_[i].jerk_share = share;
            changed = true;
        }
    }
    return changed;
}

}  // namespace motionrack::control
