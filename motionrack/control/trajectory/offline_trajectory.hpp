// A program driven along its curve: moves go in, stretches from rest to rest come out, each with its place and its
// time.
//
//   moves ──PathBuilder──► cubic pieces ──SectionPlanner──► feed profile        place(t) = curve(u(t))
//
// Along a stretch each axis keeps its speed, acceleration and jerk at every instant, the path stays within its
// tolerance, and the programmed feed is not exceeded.
#pragma once

#include <functional>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/trajectory/section_planner.hpp>
#include <motionrack/control/trajectory/trajectory_point.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

/// From rest to rest; valid while the ride's callback runs.
struct PathSection {
    std::span<const CubicSegment> curve;  ///< empty: a dwell
    std::span<const ProfileSegment> feed;
    double seconds = 0;       ///< of the motion
    double overlap = 0;       ///< s by which it begins before the stretch before it has ended
    SectionRamp before;       ///< where there is an overlap: how that one ends
    double rest_seconds = 0;  ///< of the dwell behind it
    std::int32_t line = 0;    ///< of the move that ends here
    Point end = {};
};

/// Looks at a stretch at rising times.
class SectionSampler {
  public:
    explicit SectionSampler(const PathSection& stretch) : stretch_(stretch) {}
    /// `seconds` from the stretch's begin, not before the last ones; from 0 to its end. With what is left of the
    /// stretch before.
    TrajectoryPoint at(double seconds);

  private:
    PathSection stretch_;
    std::size_t feed_ = 0, piece_ = 0;
    double feed_begin_ = 0;  ///< s
};

class OfflineTrajectory {
  public:
    using OnSection = std::function<void(const PathSection&)>;
    /// The axes stand at `start`.
    OfflineTrajectory(const MachineLimits& limits, const Point& start, OnSection on_stretch);

    /// Begins where the last move ended. All its numbers are finite, and feeds above 0.
    void push(const Move& move);
    /// The program rests here.
    void flush();

  private:
    void take();

    MachineLimits limits_;
    OnSection on_stretch_;
    PathBuilder builder_;
    SectionPlanner planner_;
    std::vector<CubicSegment> curve_;
    std::vector<SegmentTuning> use_;
    StoredRamp before_;   ///< how the stretch before ends
    double alone_ = 0;    ///< s of it in which the one before it has ended
    double room_mm_ = 0;  ///< at its end
};

}  // namespace motionrack::control
