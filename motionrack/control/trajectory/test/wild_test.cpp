// Some random programs of any shape; ten thousand of them are in deep/.
#include <gtest/gtest.h>

#include <motionrack/control/trajectory/test/offline_trajectory_checks.hpp>
#include <motionrack/control/trajectory/test/oracle.hpp>

namespace motionrack::control {
namespace {

TEST(RandomOfflineTrajectory, KeepsLimitsAndToleranceAtEveryInstant) {
    for (std::uint64_t seed = 100'001; seed <= 100'060; ++seed) {
        const trajectory_test::WildProgram program = trajectory_test::WildMaker(seed).program();
        const trajectory_test::Fault fault = trajectory_test::fault_of(program);
        ASSERT_EQ(fault.name, "") << "seed " << seed << ": " << fault.text << "\nthe least of it:\n"
                                  << trajectory_test::text_of(trajectory_test::reduced(program));
    }
}

/// A move of 6 nm takes 23 s, after a curve on which an axis needs all of its acceleration.
TEST(RandomOfflineTrajectory, IsNeverFasterThanItsBoundForAVeryShortMove) {
    const trajectory_test::Fault fault = trajectory_test::fault_of(trajectory_test::WildMaker(661189243).program());
    EXPECT_EQ(fault.name, "") << fault.text;
}

/// Between the blends of moves of nanometres, 1e-15 mm of the curve are left over.
TEST(RandomOfflineTrajectory, IsNeverFasterThanItsBoundForAVeryShortRemainder) {
    const trajectory_test::Fault fault = trajectory_test::fault_of(trajectory_test::WildMaker(58884117).program());
    EXPECT_EQ(fault.name, "") << fault.text;
}

/// The move of X is far below a pulse, so the next move includes it. The feed rate of the next move is in degrees per
/// second, although X moves a little.
TEST(RandomOfflineTrajectory, OfARotaryAxisKeepsItsFeedAfterAMoveFarBelowAPulse) {
    for (const bool moves_before : {false, true}) {
        trajectory_test::WildProgram program;
        for (AxisLimits& axis : program.limits) axis = {true, -1e9, 1e9, 100, 1000, 20'000, 1, 80};
        Move move;
        move.kind = MoveKind::feed;
        move.path = PathControl::continuous;
        move.tolerance_mm = 0.01;
        move.feed = 1;
        const auto go = [&](int axis, double to) {
            move.end[static_cast<std::size_t>(axis)] = to;
            move.line = static_cast<std::int32_t>(program.moves.size() + 1);
            program.moves.push_back(move);
        };
        if (moves_before) go(0, 5);
        go(0, move.end[0] + 1e-5);
        go(3, 0.02);
        go(1, 5);
        EXPECT_EQ(trajectory_test::fault_of(program).text, "");
    }
}

/// The arc is shorter than the move before it, which is far below a pulse and leads beyond the end of the arc. Together
/// they have nearly zero length and are not a full circle.
TEST(RandomOfflineTrajectory, MakesNoFullCircleOfAnArcShorterThanThePrecedingMove) {
    trajectory_test::WildProgram program;
    for (AxisLimits& axis : program.limits) axis = {true, -1e9, 1e9, 100, 1000, 20'000, 1, 80};
    program.start = {0, -5, 0, 0, 0, 0};
    Move to_the_arc;
    to_the_arc.kind = MoveKind::feed;
    to_the_arc.path = PathControl::continuous;
    to_the_arc.tolerance_mm = 0.01;
    to_the_arc.feed = 1;
    to_the_arc.line = 1;
    Move back = to_the_arc;
    back.end = {0, -1e-6, 0, 0, 0, 0};
    back.line = 2;
    Move arc = back;
    arc.kind = MoveKind::arc;
    arc.first = 0, arc.second = 1, arc.turns = 1;
    arc.centre_first = -10;
    arc.end = {0, -9e-7, 0, 0, 0, 0};
    arc.line = 3;
    program.moves = {to_the_arc, back, arc};
    double length = 0;
    for (const trajectory_test::KeptStretch& kept :
         trajectory_test::kept_trajectory(program.moves, program.limits, program.start))
        for (const CubicSegment& piece : kept.curve) length += piece.length;
    EXPECT_NEAR(length, 5, 0.02);
}

/// A step of the reference may be longer than a whole ramp; then it is too slow by this step at each end.
TEST(RandomOfflineTrajectory, IsNeverFasterThanItsLowerBound) {
    for (std::uint64_t seed = 100'001; seed <= 100'020; ++seed) {
        const trajectory_test::WildProgram program = trajectory_test::WildMaker(seed).program();
        for (const trajectory_test::KeptStretch& kept :
             trajectory_test::kept_trajectory(program.moves, program.limits, program.start)) {
            if (kept.curve.empty()) continue;
            EXPECT_GE(kept.section.seconds, trajectory_test::time_optimal_s(kept.curve, program.limits) * (1 - 2e-3))
                << seed << " line " << kept.section.line;
        }
    }
}

}  // namespace
}  // namespace motionrack::control
