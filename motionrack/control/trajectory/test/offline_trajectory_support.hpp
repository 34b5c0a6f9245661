// Shared by the trajectory tests: whole trajectories, copied out of the callback for later use.
#pragma once

#include <gtest/gtest.h>

#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/trajectory/offline_trajectory.hpp>
#include <vector>

namespace motionrack::control::trajectory_test {

/// A section with a copy of its segments.
struct KeptStretch {
    std::vector<CubicSegment> curve;
    std::vector<ProfileSegment> feed;
    StoredRamp before;
    PathSection section;

    explicit KeptStretch(const PathSection& from)
        : curve(from.curve.begin(), from.curve.end()), feed(from.feed.begin(), from.feed.end()), section(from) {
        before.keep(from.before);
    }
    /// Returns the section; valid while this object exists.
    PathSection view() const {
        PathSection out = section;
        out.curve = curve;
        out.feed = feed;
        out.before = before.end();
        return out;
    }
};

inline std::vector<KeptStretch> kept_trajectory(const std::vector<Move>& moves, const MachineLimits& limits,
                                                const Point& start = {}) {
    std::vector<KeptStretch> out;
    OfflineTrajectory offline_trajectory(limits, start, [&](const PathSection& section) { out.emplace_back(section); });
    for (const Move& move : moves) offline_trajectory.push(move);
    offline_trajectory.flush();
    return out;
}

inline double trajectory_seconds(const std::vector<Move>& moves, const MachineLimits& limits) {
    double seconds = 0;
    for (const KeptStretch& kept : kept_trajectory(moves, limits))
        seconds += kept.section.seconds - kept.section.overlap + kept.section.rest_seconds;
    return seconds;
}

/// Returns the duration with the trapezoidal planner, but double-S profiles from stop to stop.
inline double seconds_stopping(std::vector<Move> moves, const MachineLimits& limits) {
    LookAheadPlanner planner(limits, {});
    PlanSummary sum;
    PlannedMove planned;
    for (Move& move : moves) {
        move.path = PathControl::exact_stop;
        while (!planner.has_room() && planner.pull(planned)) sum.add(planned);
        EXPECT_TRUE(planner.push(move));
    }
    planner.flush();
    while (planner.pull(planned)) sum.add(planned);
    return sum.seconds;
}

}  // namespace motionrack::control::trajectory_test
