// The quickest speed along a part of a curve that ends at rest.
//
//   w, the square of the speed, over the path u. On a curvature an axis' acceleration is shared: what keeps it on the
//   curve grows with w, the rest changes the speed, p' w'/2 + p'' w. So first it is found how fast each piece can be,
//   from both ends, with no jerk in mind,
//
//      ╭──╮    ╱╲___╱╲     ╭──╮        what bends and feeds allow (cut off above), and what can be reached from there
//     ╱    ╲__╱       ╲___╱    ╲
//
//   and with that speed as its limit a piece leaves the acceleration that it takes to be so fast. The feed planner
//   keeps both, and the jerk. Where that turns out to be slower, there is more left to change the speed, and it is
//   planned again.
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <motionrack/control/path_velocity/velocity_planner.hpp>
#include <motionrack/control/trajectory/segment_limits.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

inline constexpr double no_speed_limit = 1e300;

/// What plans have found out about a piece.
struct SegmentTuning {
    double speed = no_speed_limit;            ///< more would leave less for changing it than it can be changed
    double jerk_share = max_curvature_share;  ///< of the axes' jerk, that the curvature may take
};

class SectionPlanner {
  public:
    explicit SectionPlanner(const MachineLimits& limits) : limits_(limits) {}

    /// From `from`, a place on the first of the pieces, to rest at `to`, on the last. `use`: what is known of the
    /// pieces, and then what this plan is by. False if nothing was found that goes on from `start`; then it is as it
    /// was.
    bool plan(const InitialPathState& start, std::span<const CubicSegment> curve, std::span<SegmentTuning> use,
              double from, double to);

    /// What was found, by places on the curve; valid until the next plan.
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
    std::vector<ProfileSegment> feed_;  ///< the quickest found
    double seconds_ = 0;                ///< of it
    // by piece
    std::vector<SegmentLimits> pieces_;
    std::vector<SegmentTuning> use_;
    std::vector<double> most_;  ///< speeds
    std::vector<LimitInterval> spans_;
    // between pieces
    std::vector<double> squares_;
};

}  // namespace motionrack::control
