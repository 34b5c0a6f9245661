// A trajectory divided into straight moves for a card: continuous positions and velocities, and complete.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/path/test/path_builder_support.hpp>
#include <motionrack/control/trajectory/trajectory_interpolator.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

using curve_test::arc_from;
using curve_test::line_to;
using curve_test::machine;

std::vector<PlannedMove> moves_of(const std::vector<Move>& program, InterpolatorSettings settings = {},
                                  const MachineLimits& limits = machine()) {
    TrajectoryInterpolator planner(limits, {}, settings);
    std::vector<PlannedMove> out;
    PlannedMove planned;
    const auto pull = [&] {
        while (planner.pull(planned)) out.push_back(planned);
    };
    for (const Move& move : program) {
        while (!planner.has_room()) pull();
        EXPECT_TRUE(planner.push(move));
    }
    planner.flush();
    pull();
    return out;
}

std::vector<Move> curvy() {
    std::vector<Move> out = {line_to({20}, 0.05), line_to({20, 15}, 0.05)};
    out.push_back(arc_from({20, 15}, pi / 2, 4, -pi, 0.05));
    out.push_back(line_to({28, -5, 3}, 0.05));
    for (int i = 1; i < 40; ++i) out.push_back(line_to({28 + 0.3 * i, -5 + 2 * sin_cos(0.2 * i).sin, 3}, 0.01));
    out.push_back(line_to({20, -5, 3}));
    return out;
}

TEST(TrajectoryInterpolator, MakesMovesThatMeetInPositionAndVelocityAndStartAndEndAtStandstill) {
    const std::vector<PlannedMove> moves = moves_of(curvy());
    ASSERT_GT(moves.size(), 100U);
    EXPECT_EQ(moves.front().entry_velocity, 0);
    EXPECT_EQ(moves.back().exit_velocity, 0);
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const PlannedMove& move = moves[i];
        EXPECT_TRUE(move.constant_accel);
        EXPECT_GT(move.length, 0);
        EXPECT_EQ(move.cruise_velocity, std::max(move.entry_velocity, move.exit_velocity));
        if (i == 0) continue;
        EXPECT_EQ(move.start, moves[i - 1].move.end);
        EXPECT_NEAR(move.entry_velocity, moves[i - 1].exit_velocity, 1e-6 + 1e-3 * move.entry_velocity);
        EXPECT_GE(move.number, moves[i - 1].number);
    }
    EXPECT_EQ(moves.back().move.end, curvy().back().end);
    EXPECT_EQ(moves.back().number, static_cast<std::int64_t>(curvy().size()) - 1);
}

/// Returns the distance from the nearest point of the moves.
double distance_to(const std::vector<PlannedMove>& moves, const Point& position) {
    double nearest = 1e9;
    for (const PlannedMove& move : moves) {
        double square = 0, along = 0, off = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double way = move.move.end[i] - move.start[i];
            square += way * way;
            along += way * (position[i] - move.start[i]);
        }
        const double part = square > 0 ? std::clamp(along / square, 0.0, 1.0) : 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double beside = move.start[i] + part * (move.move.end[i] - move.start[i]) - position[i];
            off += beside * beside;
        }
        nearest = std::min(nearest, std::sqrt(off));
    }
    return nearest;
}

/// At a low feed rate corners lie within the duration of one planned move.
TEST(TrajectoryInterpolator, StaysWithinTheCornerToleranceAndOnePulse) {
    constexpr double tolerance = 0.002;
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 random(seed);
        const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
        std::vector<Move> program;
        Point position = {};
        for (int i = 0; i < 60; ++i) {
            position[0] += between(0.01, 0.1);
            position[2] += between(-0.01, 0.01);
            program.push_back(line_to(position, tolerance));
            program.back().feed = 2;
        }
        const std::vector<PlannedMove> moves = moves_of(program);
        double max_error = 0;
        for (const Move& move : program) max_error = std::max(max_error, distance_to(moves, move.end));
        EXPECT_LT(max_error, tolerance + 1 / curve_test::pulses) << "seed " << seed;
    }
}

TEST(TrajectoryInterpolator, StepsAtJunctionsByLessThanTheMaxVelocityStep) {
    const std::vector<PlannedMove> moves = moves_of(curvy());
    double peak_step = 0;
    for (std::size_t i = 1; i < moves.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto velocity = [&](const PlannedMove& move, double along) {
                return along * (move.move.end[axis] - move.start[axis]) / move.length;
            };
            peak_step = std::max(peak_step, std::fabs(velocity(moves[i], moves[i].entry_velocity) -
                                                      velocity(moves[i - 1], moves[i - 1].exit_velocity)));
        }
    EXPECT_LT(peak_step, machine()[0].max_velocity_step);
    EXPECT_GT(peak_step, 0.1);
}

/// A card observes the acceleration of each axis on a line: with too little deceleration it enters the corner too fast.
/// On a return stroke the ends of two lines overlap.
TEST(TrajectoryInterpolator, LetsACardThatLimitsTheAccelerationOnEachMoveEnterACornerSlowly) {
    MachineLimits limits = machine();
    limits[2].max_accel = 0.5 * limits[0].max_accel;
    for (double height = 1.5; height < 20; height *= 1.2) {
        const std::vector<Move> back = {line_to({50}, 0.2), line_to({0, 0, height}, 0.2),
                                        line_to({50, 0, height}, 0.2)};
        double velocity = 0, peak_step = 0;
        for (const PlannedMove& move : moves_of(back, {}, limits)) {
            double accel = 1e9;
            for (std::size_t axis = 0; axis < 3; ++axis)
                accel = std::min(accel, limits[axis].max_accel * move.length /
                                            std::max(1e-9, std::fabs(move.move.end[axis] - move.start[axis])));
            velocity =
                std::max(move.exit_velocity, std::sqrt(std::max(0.0, velocity * velocity - 2 * accel * move.length)));
            peak_step = std::max(peak_step, velocity - move.exit_velocity);
        }
        EXPECT_LT(peak_step, limits[0].max_velocity_step) << "height " << height;
    }
}

TEST(TrajectoryInterpolator, HasTheDurationOfTheTrajectoryGenerator) {
    double seconds = 0;
    for (const PlannedMove& move : moves_of(curvy())) seconds += seconds_of(move);
    double offline_trajectory = 0;
    TrajectoryGenerator generator(machine(), {});
    const auto drive = [&] {
        while (generator.next(false) == NextMotion::motion) {
            const double pass = std::min(0.01, generator.left());
            generator.advance(pass);
            offline_trajectory += pass;
        }
    };
    for (const Move& move : curvy()) {
        if (!generator.has_room()) drive();
        generator.push({move});
    }
    generator.flush();
    drive();
    EXPECT_NEAR(seconds, offline_trajectory, 0.01 * offline_trajectory);
}

TEST(TrajectoryInterpolator, KeepsDwellsWholeOrDividesThem) {
    Move dwell;
    dwell.kind = MoveKind::dwell;
    dwell.seconds = 0.25;
    const std::vector<Move> program = {line_to({1}), dwell, line_to({2})};
    const auto seconds = [](const std::vector<PlannedMove>& moves, int& count) {
        double sum = 0;
        count = 0;
        for (const PlannedMove& move : moves)
            if (move.move.kind == MoveKind::dwell) sum += move.move.seconds, ++count;
        return sum;
    };
    int count = 0;
    EXPECT_DOUBLE_EQ(seconds(moves_of(program), count), 0.25);
    EXPECT_EQ(count, 1);
    InterpolatorSettings settings;
    settings.cut_dwells = true;
    EXPECT_NEAR(seconds(moves_of(program, settings), count), 0.25, 1e-12);
    EXPECT_EQ(count, 25);
}

TEST(TrajectoryInterpolator, RejectsInvalidMovesAndContinues) {
    TrajectoryInterpolator planner(machine(), {});
    Move bad = line_to({1});
    bad.feed = 0;
    const Result<void> refused = planner.push(bad);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("it must be above 0"), std::string::npos);
    EXPECT_TRUE(planner.push(line_to({1})));
    planner.flush();
    PlannedMove planned;
    EXPECT_TRUE(planner.pull(planned));
}

/// Hardware that interpolates two axes and uses a third as auxiliary axis.
class TwoAxes : public DriveConstraints {
  public:
    double max_junction_velocity(const Geometry&, const Geometry&) const override { return 1e9; }
    double constant_velocity_length(const Geometry&) const override { return 0; }
    int max_interpolated_axes() const override { return 2; }
    double min_velocity_update_s() const override { return 0.01; }
};

TEST(TrajectoryInterpolator, StopsBeforeACornerThatWouldTakeMoreAxesThanTheCardInterpolates) {
    const TwoAxes rule;
    InterpolatorSettings settings;
    settings.drive = &rule;
    const auto stop_count = [&](const std::vector<Move>& program) {
        int count = 0;
        for (const PlannedMove& move : moves_of(program, settings)) count += move.exit_velocity == 0;
        return count;
    };
    EXPECT_EQ(stop_count({line_to({10}, 0.5), line_to({20, 1}, 0.5), line_to({30, 0}, 0.5)}), 1);
    EXPECT_EQ(stop_count({line_to({10}, 0.5), line_to({20, 1}, 0.5), line_to({30, 1, 1}, 0.5)}), 2);
    EXPECT_EQ(stop_count({line_to({10, 1, 1}, 0.5), line_to({20, 2, 2.1}, 0.5)}), 1);
}

}  // namespace
}  // namespace motionrack::control
