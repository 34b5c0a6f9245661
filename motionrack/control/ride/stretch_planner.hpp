// The quickest speed along a part of a curve that ends at rest: limits on the pieces, and again with what the speeds found leave of them.
#pragma once

#include <motionrack/control/curve/curve.hpp>
#include <motionrack/control/feed/feed_planner.hpp>
#include <motionrack/control/limits.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

class StretchPlanner {
  public:
    explicit StretchPlanner(const MachineLimits& limits) : limits_(limits) {}

    /// From `from`, a place on the first of the pieces, to rest at `to`, on the last. `spans`: what holds on the pieces; they become narrower
    /// where that lets the speed change more. False if nothing was found that goes on from `start`; then they are as they were.
    bool plan(const FeedStart& start, std::span<const CurvePiece> curve, std::span<FeedSpan> spans, double from, double to);

    /// What was found, by places on the curve; valid until the next plan.
    std::span<const FeedPiece> feed() const { return feed_; }
    double seconds() const { return seconds_; }

  private:
    bool narrow(std::span<const CurvePiece> curve, double slack);

    MachineLimits limits_;
    FeedPlanner planner_;
    std::vector<FeedSpan> spans_;
    std::vector<FeedPiece> feed_;  ///< the quickest found
    double seconds_ = 0;           ///< of it
};

}  // namespace motionrack::control
