// Time-optimal velocity along a part of a curve that ends at standstill.
//
//   w, the square of the velocity, over the path u. On a curve two terms share an axis' acceleration, p' w'/2 + p'' w:
//   following the curve takes more of it as w grows, the rest changes the velocity. The first step finds the highest
//   velocity of each segment from both ends, without jerk limits:
//
//      ╭──╮    ╱╲___╱╲     ╭──╮        cut off by curvature and feed rates, and the velocities reachable from there
//     ╱    ╲__╱       ╲___╱    ╲
//
//   With that velocity as its limit, a segment has the remaining acceleration for changing it. The velocity planner
//   observes both, and the jerk. Where the result is slower, more acceleration remains, and the planner runs again.
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/velocity_planner.hpp>
#include <motionrack/control/trajectory/segment_limits.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

inline constexpr double no_velocity_limit = 1e300;

/// Findings of previous plans about a segment.
struct SegmentTuning {
    double velocity =
        no_velocity_limit;  ///< velocity limit; a higher one would leave too little acceleration for changing it
    double jerk_share = max_curvature_share;  ///< share of the axes' jerk for the curvature
};

class SectionPlanner {
  public:
    explicit SectionPlanner(const MachineLimits& limits) : limits_(limits) {}

    /// Plans from `from`, a position on the first segment, to standstill at `to`, on the last. `use`: findings about
    /// the segments, updated by this plan. Returns false, without any change, if no plan continues from `start`.
    bool plan(const InitialPathState& start, std::span<const CubicSegment> curve, std::span<SegmentTuning> use,
              double from, double to);

    /// Returns the profile over positions on the curve; valid until the next plan.
    std::span<const ProfileSegment> feed() const { return feed_; }
    double seconds() const { return seconds_; }

  private:
    void measure(std::span<const CubicSegment> curve, std::span<const SegmentTuning> use, double from, double to);
    void compute_reachable_velocities(const InitialPathState& start);
    double max_segment_velocity(std::size_t i, double up) const;
    bool tighten_limits(double slack);
    PathMotion max_found(double end, std::size_t& k) const;

    MachineLimits limits_;
    VelocityPlanner planner_;
    std::vector<ProfileSegment> feed_;  ///< the fastest profile found
    double seconds_ = 0;                ///< duration of that profile, s
    // one entry per segment
    std::vector<SegmentLimits> pieces_;
    std::vector<SegmentTuning> use_;
    std::vector<double> max_velocities_;  ///< highest velocity of the segment
    std::vector<LimitInterval> spans_;
    // one entry per junction of segments
    std::vector<double> squares_;
};

}  // namespace motionrack::control
