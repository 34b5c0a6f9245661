// Whole jerk-limited programs: properties at every instant, and duration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/path/test/path_builder_support.hpp>
#include <motionrack/control/trajectory/offline_trajectory.hpp>
#include <motionrack/control/trajectory/test/offline_trajectory_support.hpp>
#include <vector>

namespace motionrack::control {
namespace {

using curve_test::arc_from;
using curve_test::line_to;
using curve_test::machine;

/// Maximum use of the limits and of the programmed feed rate over all axes and instants.
struct Ridden {
    double seconds = 0, velocity = 0, accel = 0, jerk = 0;
    int rests = 0;
    Point end = {};
    std::vector<TrajectoryPoint> states;
};

Ridden offline_trajectory(const std::vector<Move>& moves, double step = 0.0005) {
    Ridden out;
    const MachineLimits limits = machine();
    OfflineTrajectory offline_trajectory(limits, {}, [&](const PathSection& section) {
        out.seconds += section.seconds - section.overlap + section.rest_seconds;
        out.rests += !section.curve.empty();
        out.end = section.end;
        if (section.curve.empty()) return;
        SectionSampler view(section);
        const int steps = std::clamp(static_cast<int>(section.seconds / step), 50, 4000);
        for (int i = 0; i <= steps; ++i) {
            const TrajectoryPoint state = view.at(section.seconds * i / steps);
            for (std::size_t axis = 0; axis < limits.size(); ++axis) {
                out.velocity = std::max(out.velocity, std::fabs(state.velocity[axis]) / limits[axis].max_velocity);
                out.accel = std::max(out.accel, std::fabs(state.accel[axis]) / limits[axis].max_accel);
                out.jerk = std::max(out.jerk, std::fabs(state.jerk[axis]) / limits[axis].max_jerk);
            }
            out.states.push_back(state);
        }
    });
    for (const Move& move : moves) offline_trajectory.push(move);
    offline_trajectory.flush();
    return out;
}

std::vector<Move> square_wave(int legs, double length, double tolerance_mm) {
    std::vector<Move> out;
    for (int i = 1; i <= legs; ++i) out.push_back(line_to({(i + 1) / 2 * length, (i / 2) % 2 * length}, tolerance_mm));
    return out;
}

TEST(OfflineTrajectory, KeepsEveryAxisWithinItsLimitsAtEveryInstant) {
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        const Ridden ridden = offline_trajectory(curve_test::ProgramMaker(seed).program(4));
        ASSERT_LE(ridden.velocity, 1 + 1e-6) << seed;
        ASSERT_LE(ridden.accel, 1 + 1e-6) << seed;
        ASSERT_LE(ridden.jerk, 1 + 1e-6) << seed;
    }
}

TEST(OfflineTrajectory, HasNoStepsInPositionOrVelocity) {
    std::vector<Move> moves = square_wave(6, 10, 0.05);
    const Move arc = arc_from(moves.back().end, 0, 8, 4);
    moves.push_back(arc);
    const Ridden ridden = offline_trajectory(moves, 1e-5);
    for (std::size_t i = 1; i < ridden.states.size(); ++i) {
        const TrajectoryPoint &a = ridden.states[i - 1], &b = ridden.states[i];
        if (b.u < a.u) continue;  // the next section, which starts before this one ends
        for (std::size_t axis = 0; axis < 2; ++axis) {
            ASSERT_NEAR(a.position[axis], b.position[axis], 0.05);
            ASSERT_NEAR(a.velocity[axis], b.velocity[axis], 1.0);
        }
    }
}

TEST(OfflineTrajectory, OfAStraightLineIsAnSCurve) {
    const Ridden ridden = offline_trajectory({line_to({100, 0})});
    EXPECT_NEAR(ridden.seconds, 1 + 100.0 / 2000 + 2000.0 / 40'000,
                1e-9);  // distance / velocity + velocity / acceleration + acceleration / jerk
    EXPECT_EQ(ridden.end[0], 100);
}

TEST(OfflineTrajectory, UsesTheToleranceOfACorner) {
    const double stopping = trajectory_test::seconds_stopping(square_wave(40, 20, 0), machine());
    double last = stopping * 1.015;
    for (const double tolerance : {0.001, 0.01, 0.1}) {
        const double seconds = offline_trajectory(square_wave(40, 20, tolerance)).seconds;
        EXPECT_LT(seconds, last) << tolerance;
        last = seconds - 0.1;
    }
    EXPECT_LT(last, 0.9 * stopping);
}

TEST(OfflineTrajectory, StaysWithinTheToleranceAtCorners) {
    for (const double tolerance : {0.001, 0.02, 0.2}) {
        const std::vector<Move> moves = square_wave(8, 10, tolerance);
        const std::vector<Geometry> paths = curve_test::paths_of(moves);
        double farthest = 0;
        for (const TrajectoryPoint& state : offline_trajectory(moves).states) {
            double nearest = 1e9;
            for (const Geometry& path : paths)
                nearest = std::min(nearest, distance_to(path, state.position[0], state.position[1], state.position[2]));
            farthest = std::max(farthest, nearest);
        }
        EXPECT_LE(farthest, tolerance) << tolerance;
        EXPECT_GE(farthest, 0.3 * tolerance) << tolerance;
    }
}

TEST(OfflineTrajectory, OfAZigzagIsAtMostSlightlySlowerThanWithExactStops) {
    for (const double tolerance : {0.001, 0.02, 0.1, 1.0})
        for (const double length : {0.5, 5.0, 50.0}) {
            std::vector<Move> moves;
            for (int i = 1; i <= 30; ++i) moves.push_back(line_to({i * length, i % 2 * length}, tolerance));
            EXPECT_LE(offline_trajectory(moves).seconds, 1.03 * trajectory_test::seconds_stopping(moves, machine()))
                << tolerance << " " << length;
        }
}

TEST(OfflineTrajectory, TakesACircleAtTheVelocityOfItsCurvature) {
    const Ridden ridden = offline_trajectory({arc_from({}, 0, 5, 12 * pi)});
    double peak_velocity = 0;
    for (const TrajectoryPoint& state : ridden.states)
        peak_velocity = std::max(
            peak_velocity, std::sqrt(state.velocity[0] * state.velocity[0] + state.velocity[1] * state.velocity[1]));
    EXPECT_GT(peak_velocity, 0.97 * std::sqrt(0.8 * 2000 * 5));
    EXPECT_EQ(ridden.rests, 1);
}

TEST(OfflineTrajectory, DoesNotStopAtTangentJunctions) {
    std::vector<Move> moves = {line_to({50, 0}), arc_from({50, 0}, 0, 10, pi), line_to({0, 20})};
    for (Move& move : moves) move.path = PathControl::exact_path;
    EXPECT_EQ(offline_trajectory(moves).rests, 1);
}

/// Chords on a smooth curve take at most the time of its curvature and feed rate, plus one double-S profile.
TEST(OfflineTrajectory, RunsThroughManyChordsAsThroughTheCurve) {
    std::vector<Move> moves;
    double min_seconds = 0;
    Point at{};
    for (int i = 1; i <= 4000; ++i) {
        const double x = 0.05 * i;
        const SinCos wave = sin_cos(x / 15);
        Move move = line_to({x, 20 * wave.sin});
        const double slope = 20.0 / 15 * wave.cos,
                     curvature = 20.0 / 225 * std::fabs(wave.sin) / std::pow(1 + slope * slope, 1.5);
        min_seconds += std::hypot(move.end[0] - at[0], move.end[1] - at[1]) /
                       std::min(100.0, std::sqrt(2000 / std::max(curvature, 1e-9)));
        at = move.end;
        moves.push_back(move);
    }
    EXPECT_LE(offline_trajectory(moves).seconds, 1.12 * min_seconds + 0.1);
}

TEST(OfflineTrajectory, StandsStillForDwells) {
    Move dwell;
    dwell.kind = MoveKind::dwell;
    dwell.seconds = 0.25;
    dwell.end = {10, 0};
    const double without = offline_trajectory({line_to({10, 0}), line_to({10, 10}, 0)}).seconds;
    const Ridden ridden = offline_trajectory({line_to({10, 0}), dwell, line_to({10, 10}, 0)});
    EXPECT_GE(ridden.seconds, without + 0.25 - 1e-3);
}

}  // namespace
}  // namespace motionrack::control
