// Trajectory of a whole program: moves are pushed; path sections from standstill to standstill come out with their
// timing.
//
//   moves ──PathBuilder──► cubic segments ──SectionPlanner──► velocity profile        position(t) = curve(u(t))
//
// Within a section each axis observes its velocity, acceleration and jerk limits at every instant. The path stays
// within its tolerance, and the velocity within the programmed feed rate.
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

/// A path section from standstill to standstill; valid while the callback runs.
struct PathSection {
    std::span<const CubicSegment> curve;  ///< empty: a dwell
    std::span<const ProfileSegment> feed;
    double seconds = 0;       ///< duration of the motion
    double overlap = 0;       ///< time by which it starts before the end of the previous section, s
    SectionRamp before;       ///< with an overlap: the final deceleration of the previous section
    double rest_seconds = 0;  ///< duration of the dwell behind it
    std::int32_t line = 0;    ///< line of the move that ends here
    Point end = {};
};

/// Samples a section; times must not decrease.
class SectionSampler {
  public:
    explicit SectionSampler(const PathSection& section) : section_(section) {}
    /// Returns the point at `seconds` from the start of the section, from 0 to its end; not before the previous call.
    /// Includes the remaining motion of the previous section.
    TrajectoryPoint at(double seconds);

  private:
    PathSection section_;
    std::size_t feed_ = 0, piece_ = 0;
    double feed_begin_ = 0;  ///< start of the current profile segment, s from the start of the section
};

class OfflineTrajectory {
  public:
    using OnSection = std::function<void(const PathSection&)>;
    /// `start`: the current position, at standstill.
    OfflineTrajectory(const MachineLimits& limits, const Point& start, OnSection on_section);

    /// Adds a move that starts where the last one ended. All its numbers are finite, and feed rates above 0.
    void push(const Move& move);
    /// Ends the path with a standstill.
    void flush();

  private:
    void take();

    MachineLimits limits_;
    OnSection on_section_;
    PathBuilder builder_;
    SectionPlanner planner_;
    std::vector<CubicSegment> curve_;
    std::vector<SegmentTuning> use_;
    StoredRamp before_;   ///< final deceleration of the previous section
    double alone_ = 0;    ///< duration of the previous section without its overlap, s
    double room_mm_ = 0;  ///< corner tolerance at the end of the previous section
};

}  // namespace motionrack::control
