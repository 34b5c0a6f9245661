#include <algorithm>
#include <motionrack/control/trajectory/offline_trajectory.hpp>
#include <motionrack/control/trajectory/subdivide.hpp>
#include <utility>

namespace motionrack::control {

TrajectoryPoint SectionSampler::at(double seconds) {
    const auto& feed = section_.feed;
    const auto& curve = section_.curve;
    while (feed_ + 1 < feed.size() && seconds > feed_begin_ + feed[feed_].seconds) feed_begin_ += feed[feed_++].seconds;
    const PathMotion along = feed[feed_].at(std::clamp(seconds - feed_begin_, 0.0, feed[feed_].seconds));
    while (piece_ + 1 < curve.size() && along.u > curve[piece_ + 1].begin) ++piece_;
    TrajectoryPoint out = trajectory_point(curve[piece_], along);
    if (seconds < section_.overlap) add_overlap(out, section_.before, section_.overlap - seconds);
    return out;
}

OfflineTrajectory::OfflineTrajectory(const MachineLimits& limits, const Point& start, OnSection on_section)
    : limits_(limits), on_section_(std::move(on_section)), builder_(limits, start), planner_(limits) {}

void OfflineTrajectory::push(const Move& move) {
    if (!builder_.has_room()) take();
    builder_.push(move);
}

void OfflineTrajectory::flush() {
    if (!builder_.has_room()) take();
    builder_.flush();
    take();
}

void OfflineTrajectory::take() {
    PathElement item;
    while (builder_.pull(item)) {
        if (!item.rest) {
            for_each_subsegment(item.piece, limits_, [&](const CubicSegment& part) {
                curve_.push_back(part);
                use_.emplace_back();
            });
            continue;
        }
        PathSection section{curve_, {}, 0, 0, before_.end(), item.seconds, item.line, item.at};
        if (!curve_.empty() && planner_.plan({}, curve_, use_, 0, curve_.back().begin + curve_.back().length)) {
            section.feed = planner_.feed();
            section.seconds = planner_.seconds();
            section.overlap =
                max_overlap_s(section.before, initial_acceleration(curve_, section.feed), alone_, room_mm_, limits_);
        }
        on_section_(section);
        before_.keep(final_deceleration(curve_, section.feed));
        alone_ = section.seconds - section.overlap;
        room_mm_ = curve_.empty() ? 0 : item.corner_tolerance_mm;
        curve_.clear();
        use_.clear();
    }
}

}  // namespace motionrack::control
