// The look-ahead: cases computed by hand, and properties of any program.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/split_move.hpp>
#include <vector>

namespace motionrack::control {
namespace {

MachineLimits path_machine() {
    MachineLimits limits;
    for (int i = 0; i < axis_count; ++i) limits[i] = {true, -1e6, 1e6, 100, 1000, 0, 2, 1000};
    limits[1].max_velocity = 80;
    limits[1].max_accel = 600;
    limits[2].max_velocity = 40;
    limits[2].max_accel = 300;
    limits[2].max_velocity_step = 1;
    limits[3].max_velocity = 3600;
    limits[3].max_accel = 7200;
    limits[3].max_velocity_step = 20;
    return limits;
}

Move path_line_to(double x, double y, double z = 0, double feed = 50, PathControl path = PathControl::exact_path) {
    Move move;
    move.kind = MoveKind::feed;
    move.path = path;
    move.feed = feed;
    move.end = {x, y, z, 0, 0, 0};
    return move;
}

std::vector<PlannedMove> plan_path(const MachineLimits& limits, const std::vector<Move>& moves, int window = 1024,
                                   const DriveConstraints* drive = nullptr) {
    LookAheadPlanner planner(limits, Point{}, {window, drive});
    std::vector<PlannedMove> out;
    PlannedMove planned;
    for (const Move& move : moves) {
        while (!planner.has_room() && planner.pull(planned)) out.push_back(planned);
        const Result<void> pushed = planner.push(move);
        EXPECT_TRUE(pushed.has_value()) << pushed.error().text();
    }
    planner.flush();
    while (planner.pull(planned)) out.push_back(planned);
    return out;
}

TEST(LookAheadPlanner, ASingleLongLineReachesTheFeedAndStops) {
    const auto out = plan_path(path_machine(), {path_line_to(100, 0)});
    ASSERT_EQ(out.size(), 1u);
    EXPECT_EQ(out[0].entry_velocity, 0);
    EXPECT_EQ(out[0].exit_velocity, 0);
    EXPECT_DOUBLE_EQ(out[0].cruise_velocity, 50);
    EXPECT_DOUBLE_EQ(out[0].accel, 1000);
    EXPECT_DOUBLE_EQ(out[0].length, 100);
    EXPECT_NEAR(seconds_of(out[0]), 100.0 / 50 + 50.0 / 1000, 1e-12);
}

TEST(LookAheadPlanner, AShortLineReachesOnlyThePeakOfItsTriangle) {
    const auto out = plan_path(path_machine(), {path_line_to(0.9, 0)});
    EXPECT_DOUBLE_EQ(out[0].cruise_velocity, 30);
    EXPECT_NEAR(seconds_of(out[0]), 2 * 30.0 / 1000, 1e-12);
}

TEST(LookAheadPlanner, PullsThePartsOfARapidAsTheWholeRapidWhereThePathRestsBehindIt) {
    MachineLimits limits = path_machine();
    for (AxisLimits& axis : limits) axis.max_jerk = 20'000;
    Move rapid = path_line_to(100, 50);
    rapid.kind = MoveKind::rapid;
    const PlannedMove whole = plan_path(limits, {rapid}).at(0);
    const Geometry path = geometry_of(rapid, Point{});
    LookAheadPlanner planner(limits, Point{});
    for (int i = 0; i < 4; ++i)
        ASSERT_TRUE(planner.push(sub_move(rapid, path, i * path.length / 4, (i + 1) * path.length / 4)));
    EXPECT_TRUE(planner.is_from_rest_to_rest(4, true));
    EXPECT_FALSE(planner.is_from_rest_to_rest(4, false)) << "a next move may go on without a stop";
    EXPECT_FALSE(planner.is_from_rest_to_rest(3, true));
    ASSERT_TRUE(planner.push(path_line_to(100, 20)));
    EXPECT_TRUE(planner.is_from_rest_to_rest(4, false)) << "the path rests in its corner";
    PlannedMove planned;
    planner.pull_as_one(4, planned);
    EXPECT_EQ(planned.moves, 4);
    EXPECT_EQ(planned.move.end, whole.move.end);
    EXPECT_EQ(planned.length, whole.length);
    EXPECT_EQ(planned.cruise_velocity, whole.cruise_velocity);
    EXPECT_EQ(planned.accel, whole.accel);
    EXPECT_GT(planned.jerk, 0);
    EXPECT_EQ(planned.jerk, whole.jerk);
    EXPECT_EQ(planned.entry_velocity, 0);
    EXPECT_EQ(planned.exit_velocity, 0);
    ASSERT_TRUE(planner.pull_early(planned));
    EXPECT_EQ(planned.entry_velocity, 0);
    EXPECT_DOUBLE_EQ(planned.length, 30);
}

TEST(LookAheadPlanner, TheSlowestAxisLimitsADiagonal) {
    Move move = path_line_to(30, 40);
    move.kind = MoveKind::rapid;
    const auto out = plan_path(path_machine(), {move});
    EXPECT_DOUBLE_EQ(out[0].cruise_velocity, 100);  // 80 / 0.8 in Y, 100 / 0.6 in X
    EXPECT_DOUBLE_EQ(out[0].accel, 750);            // 600 / 0.8 in Y, 1000 / 0.6 in X
}

TEST(LookAheadPlanner, InverseTimeTakesTheProgrammedTime) {
    Move move = path_line_to(10, 0);
    move.feed_mode = FeedMode::inverse_time;
    move.feed = 2;
    EXPECT_DOUBLE_EQ(plan_path(path_machine(), {move})[0].cruise_velocity, 20);
}

TEST(LookAheadPlanner, RotaryMovesAreMeasuredInDegreesOfTheFastestAxis) {
    Move move = path_line_to(0, 0, 0, 500);
    move.end = {0, 0, 0, 360, 90, 0};
    const auto out = plan_path(path_machine(), {move});
    EXPECT_DOUBLE_EQ(out[0].length, 360);
    EXPECT_DOUBLE_EQ(out[0].cruise_velocity, 400);  // B: 100 / 0.25
    EXPECT_DOUBLE_EQ(out[0].accel, 4000);           // B: 1000 / 0.25
}

TEST(LookAheadPlanner, ExactPathStopsAtACornerAndPassesATangentJunction) {
    const auto out = plan_path(path_machine(), {path_line_to(20, 0), path_line_to(40, 0, 0, 30), path_line_to(40, 20)});
    ASSERT_EQ(out.size(), 3u);
    EXPECT_DOUBLE_EQ(out[0].exit_velocity, 30);
    EXPECT_DOUBLE_EQ(out[1].entry_velocity, 30);
    EXPECT_EQ(out[1].exit_velocity, 0);
    EXPECT_EQ(out[2].entry_velocity, 0);
}

TEST(LookAheadPlanner, ExactPathDetectsACornerOfAHundredthOfADegree) {
    const double beyond = 0.02 * 0.017453292519943295;
    const double within = 0.005 * 0.017453292519943295;
    EXPECT_EQ(plan_path(path_machine(), {path_line_to(20, 0), path_line_to(40, 20 * beyond)})[0].exit_velocity, 0);
    EXPECT_NEAR(plan_path(path_machine(), {path_line_to(20, 0), path_line_to(40, 20 * within)})[0].exit_velocity, 50,
                1e-9);
}

TEST(LookAheadPlanner, ExactStopStandsStillAtEveryJunction) {
    std::vector<Move> moves;
    for (int i = 1; i <= 5; ++i) moves.push_back(path_line_to(10 * i, 0, 0, 50, PathControl::exact_stop));
    for (const PlannedMove& planned : plan_path(path_machine(), moves)) {
        EXPECT_EQ(planned.entry_velocity, 0);
        EXPECT_EQ(planned.exit_velocity, 0);
    }
}

TEST(LookAheadPlanner, ContinuousCornersObeyTheVelocityStepOfTheAxes) {
    Move first = path_line_to(20, 0, 0, 50, PathControl::continuous);
    first.tolerance_mm = 100;
    const auto out = plan_path(path_machine(), {first, path_line_to(20, 20)});
    EXPECT_DOUBLE_EQ(out[0].exit_velocity, 2);  // X stops, so the whole velocity is its step
}

TEST(LookAheadPlanner, ContinuousCornersObeyTheTolerance) {
    MachineLimits limits = path_machine();
    for (AxisLimits& axis : limits) {
        axis.max_velocity_step = 1000;
        axis.max_accel = 1000;
    }
    Move first = path_line_to(20, 0, 0, 50, PathControl::continuous);
    first.tolerance_mm = 0.01;
    const auto out = plan_path(limits, {first, path_line_to(20, 20)});
    // a right angle: s = sin 45 degrees; both axes contribute, so a = 1000 sqrt 2
    const double s = std::sqrt(0.5);
    EXPECT_NEAR(out[0].exit_velocity, std::sqrt(1000 * std::sqrt(2.0) * 0.01 * s / (1 - s)), 1e-9);
}

TEST(LookAheadPlanner, StopsWhereThePathReverses) {
    Move first = path_line_to(20, 0, 0, 50, PathControl::continuous);
    first.tolerance_mm = 1;
    EXPECT_EQ(plan_path(path_machine(), {first, path_line_to(0, 0)})[0].exit_velocity, 0);
}

TEST(LookAheadPlanner, XyzAndRotaryMovesMeetAtStandstill) {
    Move first = path_line_to(20, 0, 0, 50, PathControl::continuous);
    first.tolerance_mm = 100;
    Move second = first;
    second.end = {20, 0, 0, 90, 0, 0};
    EXPECT_EQ(plan_path(path_machine(), {first, second})[0].exit_velocity, 0);
}

TEST(LookAheadPlanner, ALineIntoATangentArcKeepsTheCentripetalLimitOfTheArc) {
    Move arc = path_line_to(30, 10);
    arc.kind = MoveKind::arc;
    arc.turns = 1;
    arc.centre_first = 20;
    arc.centre_second = 10;
    const auto out = plan_path(path_machine(), {path_line_to(20, 0), arc});
    // the lower max_accel of X and Y is 600
    EXPECT_NEAR(out[0].exit_velocity, 50, 1e-9);
    EXPECT_NEAR(out[1].accel, 0.4 * 600, 1e-9);
    arc.end = {20.5, 0.5, 0, 0, 0, 0};
    arc.centre_second = 0.5;
    EXPECT_NEAR(plan_path(path_machine(), {path_line_to(20, 0), arc})[0].exit_velocity, std::sqrt(0.8 * 600 * 0.5),
                1e-9);
}

TEST(LookAheadPlanner, ASteepHelixHasLessCentripetalAccelerationThanItsCircle) {
    Move helix = path_line_to(0.1, 0, 0.2 * 3.14159265358979323846);
    helix.kind = MoveKind::arc;
    helix.turns = 1;
    MachineLimits limits = path_machine();
    limits[2] = limits[0];
    // as high as its arc is long: the centripetal acceleration is v^2 / 2r; the arc is sqrt 1/2 of the path length
    const Geometry path = geometry_of(helix, {0.1, 0, 0, 0, 0, 0});
    const AlongPathLimits along = PathLimits(limits).along(path, helix);
    EXPECT_NEAR(along.velocity, std::sqrt(0.8 * 600 * 0.1 / 0.5), 1e-9);
    EXPECT_NEAR(along.accel, 0.4 * 600 / std::sqrt(0.5), 1e-9);
}

TEST(LookAheadPlanner, ShortLinesOnAnArcAreNotFasterThanTheArc) {
    MachineLimits limits = path_machine();
    for (AxisLimits& axis : limits) {
        axis.max_velocity_step = 1000;
        axis.max_accel = 1000;
    }
    Move first = path_line_to(0.1, 0, 0, 50, PathControl::continuous);
    first.tolerance_mm = 100;
    const Geometry before = geometry_of(first, Point{});
    const Move second = path_line_to(0.1 + 0.08, 0.06);
    const Geometry after = geometry_of(second, first.end);
    // the velocity of Y increases by 0.6 of the path velocity within 0.1 mm: v * 0.6 v / 0.1 <= 1000
    const double squared =
        PathLimits(limits).max_junction_velocity2(before, 50, after, 50, PathControl::continuous, 100);
    EXPECT_NEAR(squared, 1000 * 0.1 / 0.6, 1e-9);
}

TEST(LookAheadPlanner, TwoThousandShortCollinearLinesReachTheFullFeed) {
    std::vector<Move> moves;
    for (int i = 1; i <= 2000; ++i) moves.push_back(path_line_to(0.01 * i, 0, 0, 100));
    const auto out = plan_path(path_machine(), moves);
    ASSERT_EQ(out.size(), 2000u);
    // 100 mm/s take 5 mm: 500 lines for acceleration and 500 for deceleration
    EXPECT_NEAR(out[1000].entry_velocity, 100, 1e-9);
    EXPECT_NEAR(out[499].exit_velocity, 100, 1e-6);
    EXPECT_NEAR(out[1500].entry_velocity, 100, 1e-6);
    EXPECT_NEAR(out[250].entry_velocity, std::sqrt(2 * 1000 * 2.5), 1e-6);
    double seconds = 0;
    for (const PlannedMove& planned : out) seconds += seconds_of(planned);
    EXPECT_NEAR(seconds, 20.0 / 100 + 100.0 / 1000, 1e-9);
}

TEST(LookAheadPlanner, ADwellEndsTheWindowAtStandstill) {
    Move dwell;
    dwell.kind = MoveKind::dwell;
    dwell.seconds = 0.25;
    const auto out = plan_path(path_machine(), {path_line_to(20, 0), dwell, path_line_to(40, 0)});
    ASSERT_EQ(out.size(), 3u);
    EXPECT_EQ(out[0].exit_velocity, 0);
    EXPECT_EQ(out[1].length, 0);
    EXPECT_EQ(out[1].start, out[1].move.end);
    EXPECT_EQ(seconds_of(out[1]), 0.25);
    EXPECT_EQ(out[2].entry_velocity, 0);
    EXPECT_EQ(out[2].start, out[0].move.end);
    PlanSummary summary;
    for (const PlannedMove& planned : out) summary.add(planned);
    EXPECT_EQ(summary.moves, 2);
    EXPECT_EQ(summary.dwells, 1);
    EXPECT_EQ(summary.stops, 2);
    EXPECT_DOUBLE_EQ(summary.path_mm, 40);
    EXPECT_DOUBLE_EQ(summary.peak_velocity, 50);
}

TEST(LookAheadPlanner, MovesWithoutLengthAreSkipped) {
    const auto out = plan_path(path_machine(), {path_line_to(20, 0), path_line_to(20, 0), path_line_to(40, 0)});
    ASSERT_EQ(out.size(), 2u);
    EXPECT_DOUBLE_EQ(out[0].exit_velocity, 50);
}

TEST(LookAheadPlanner, LimitsJerkOnlyOfStraightMovesFromStandstillToStandstill) {
    MachineLimits limits = path_machine();
    for (AxisLimits& axis : limits) axis.max_jerk = 50'000;
    const auto out = plan_path(limits, {path_line_to(30, 40), path_line_to(60, 80), path_line_to(60, 100)});
    EXPECT_EQ(out[0].jerk, 0);
    EXPECT_EQ(out[1].jerk, 0);
    EXPECT_DOUBLE_EQ(out[2].jerk, 50'000);
    EXPECT_GT(seconds_of(out[2]), 20.0 / 50 + 50.0 / 600);
    limits[1].max_jerk = 0;
    EXPECT_EQ(plan_path(limits, {path_line_to(30, 40)})[0].jerk, 0);
}

TEST(LookAheadPlanner, RefusesWhatTheMachineCannotDoAndContinues) {
    MachineLimits limits = path_machine();
    limits[4].present = false;
    LookAheadPlanner planner(limits, Point{});
    Move absent = path_line_to(1, 0);
    absent.end[4] = 5;
    absent.line = 12;
    const auto refused = planner.push(absent);
    ASSERT_FALSE(refused.has_value());
    EXPECT_NE(refused.error().message.find("line 12 moves axis B by 5"), std::string::npos) << refused.error().message;
    EXPECT_FALSE(planner.push(path_line_to(std::nan(""), 0)).has_value());
    EXPECT_FALSE(planner.push(path_line_to(std::numeric_limits<double>::infinity(), 0)).has_value());
    EXPECT_FALSE(planner.push(path_line_to(5, 0, 0, 0)).has_value());
    Move arc = path_line_to(5, 0);
    arc.kind = MoveKind::arc;
    EXPECT_FALSE(planner.push(arc).has_value());
    Move dwell;
    dwell.kind = MoveKind::dwell;
    dwell.seconds = -1;
    EXPECT_FALSE(planner.push(dwell).has_value());
    EXPECT_EQ(planner.position(), Point{});
    EXPECT_TRUE(planner.push(path_line_to(5, 0)).has_value());
    planner.flush();
    PlannedMove planned;
    ASSERT_TRUE(planner.pull(planned));
    EXPECT_FALSE(planner.pull(planned));
}

/// Hardware that needs the whole length of a move at constant velocity.
class SpendsAll : public DriveConstraints {
  public:
    double max_junction_velocity(const Geometry&, const Geometry&) const override { return 1e9; }
    double constant_velocity_length(const Geometry& path) const override { return path.length; }
};

TEST(LookAheadPlanner, PlansAFiniteDurationIfTheConstantVelocityLengthIsTheWholeMove) {
    const SpendsAll rule;
    LookAheadPlanner planner(path_machine(), Point{}, {16, &rule});
    ASSERT_TRUE(planner.push(path_line_to(0.0025, 0)));
    planner.flush();
    PlannedMove planned;
    ASSERT_TRUE(planner.pull(planned));
    EXPECT_GT(planned.cruise_velocity, 0);
    EXPECT_LE(planned.cruise_velocity * planned.cruise_velocity, planned.accel * planned.length * (1 + 1e-12));
    EXPECT_LT(seconds_of(planned), 0.1);
}

/// Hardware whose pulse rate gives a higher velocity where Z starts to move.
class QuickerBehindTheCorner : public DriveConstraints {
  public:
    static constexpr double ratio = 1.5;
    double max_junction_velocity(const Geometry&, const Geometry&) const override { return 1e9; }
    double constant_velocity_length(const Geometry&) const override { return 0; }
    double velocity_ratio(const Geometry& before, const Geometry& after) const override {
        return before.tangent_out[2] == 0 && after.tangent_in[2] != 0 ? ratio : 1;
    }
};

TEST(LookAheadPlanner, DeceleratesToTheRateOfTheHardwareBehindACorner) {
    const QuickerBehindTheCorner rule;
    Move before = path_line_to(20.2, 0, 0, 50, PathControl::continuous);
    before.tolerance_mm = 100;
    const auto out = plan_path(path_machine(), {path_line_to(20, 0), before, path_line_to(40, 0, 6)}, 1024, &rule);
    ASSERT_EQ(out.size(), 3u);
    EXPECT_GT(out[2].entry_velocity, 3);
    EXPECT_DOUBLE_EQ(out[1].exit_velocity, out[2].entry_velocity)
        << "as told to the hardware, which takes the lesser rate";
    const double min_velocity = out[2].entry_velocity / QuickerBehindTheCorner::ratio;
    EXPECT_NEAR(out[1].entry_velocity, std::sqrt(min_velocity * min_velocity + 2 * out[1].accel * out[1].length), 1e-9);
    EXPECT_LT(out[1].entry_velocity, 50);
}

TEST(LookAheadPlanner, DeliversMovesBeforeTheEndOfTheProgram) {
    LookAheadPlanner planner(path_machine(), Point{}, {16});
    PlannedMove planned;
    int pulled = 0;
    for (int i = 1; i <= 100; ++i) {
        ASSERT_TRUE(planner.has_room());
        ASSERT_TRUE(planner.push(path_line_to(0.01 * i, 0)).has_value());
        while (planner.pull(planned)) ++pulled;
        EXPECT_GE(pulled, i - 20);
    }
}

}  // namespace
}  // namespace motionrack::control
