// Trajectories compared with exact stops and double-S profiles, on programs of straight lines. The choice between
// passing and stopping uses estimated durations, so a few programs would be slightly faster with stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/path/test/path_builder_support.hpp>
#include <motionrack/control/trajectory/test/offline_trajectory_support.hpp>

namespace motionrack::control {
namespace {

using curve_test::line_to;
using curve_test::machine;

double times_stopping(const std::vector<Move>& moves) {
    return trajectory_test::trajectory_seconds(moves, machine()) / trajectory_test::seconds_stopping(moves, machine());
}

TEST(OfflineTrajectoryComparedWithExactStops, IsRarelySlower) {
    int slower = 0, tried = 0;
    double max_times = 0;
    for (std::uint64_t seed = 1; seed < 1000; ++seed) {
        const std::vector<Move> moves = curve_test::ProgramMaker(seed).program(2);
        if (std::any_of(moves.begin(), moves.end(), [](const Move& move) { return move.kind == MoveKind::arc; }))
            continue;
        const double times = times_stopping(moves);
        ++tried;
        slower += times > 1.02;
        max_times = std::max(max_times, times);
    }
    RecordProperty("slower", slower);
    RecordProperty("most", std::to_string(max_times));
    EXPECT_LE(slower, 0.005 * tried) << "of " << tried;
    EXPECT_LE(max_times, 1.04);
}

/// The program has a short, a long and a short line, with corners of 40 degrees.
TEST(OfflineTrajectoryComparedWithExactStops, IsNotSlowerBetweenShortLines) {
    std::vector<Move> moves = {line_to({0.25, 0}, 0.01), line_to({1.35, 0.92}, 0.01), line_to({1.6, 0.92}, 0.01)};
    EXPECT_LE(times_stopping(moves), 1.0);
}

/// The program is nearly straight: corners of 1e-4 rad.
TEST(OfflineTrajectoryComparedWithExactStops, TakesTheProgrammedTimeInInverseTime) {
    std::vector<Move> moves;
    double x = 0, y = 0, heading = 0, programmed = 0;
    for (const double length : {0.043, 0.014, 0.143, 0.014, 0.043}) {
        x += length;
        y += length * heading;
        heading += 1e-4;
        moves.push_back(line_to({x, y}, 0.01));
        moves.back().feed_mode = FeedMode::inverse_time;
        moves.back().feed = length < 0.02 ? 2 : 3;
        programmed += 1 / moves.back().feed;
    }
    const double seconds = trajectory_test::trajectory_seconds(moves, machine());
    EXPECT_GE(seconds, programmed);
    EXPECT_LE(seconds, 1.02 * programmed);
}

}  // namespace
}  // namespace motionrack::control
