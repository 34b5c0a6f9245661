// Programs that are executed while moves still arrive, with overrides, holds and resumes: properties at every instant.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/trajectory/test/driven.hpp>
#include <motionrack/control/trajectory/test/offline_trajectory_support.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

using trajectory_test::Driven;
using trajectory_test::expect_end;
using trajectory_test::expect_limits;
using trajectory_test::line_to;
using trajectory_test::long_line;
using trajectory_test::machine;
using trajectory_test::program;

TEST(TrajectoryGeneratorLeftAlone, IsAsFastAsTheOfflineTrajectoryAndSlightlySlowerWithAShortWindow) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::vector<Move> moves = program(random);
        const bool knows_all = seed % 2 == 0;
        Driven driven(moves, {knows_all ? std::size_t{16'384} : 60});
        while (driven.step(0.0015, false)) {
        }
        expect_limits(driven);
        expect_end(driven, moves.back().end);
        EXPECT_NEAR(driven.now, trajectory_test::trajectory_seconds(moves, machine()),
                    (knows_all ? 1e-3 : 0.1) * driven.now);
    }
}

TEST(TrajectoryGeneratorDisturbedAtRandom, KeepsAllLimitsAndEndsWhereTheProgramEnds) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::vector<Move> moves = program(random);
        Driven driven(moves, {64});
        const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
        double wish = between(0.05, 0.5), resume = 1e9;
        for (int steps = 0; driven.step(between(0.0005, 0.0025), true) || resume < 1e9; ++steps) {
            ASSERT_LT(steps, 1'000'000);
            if (driven.generator.is_stationary()) driven.pass_time(0.001);
            if (driven.now > wish && resume == 1e9) {
                if (random() % 3 == 0) {
                    driven.generator.hold();
                    resume = driven.now + between(0, 0.6);
                } else {
                    driven.generator.set_overrides(between(0.05, 2), between(0.05, 1));
                }
                wish = driven.now + between(0.1, 0.6);
            }
            if (driven.now < resume) continue;
            driven.generator.resume();
            resume = 1e9;
        }
        expect_limits(driven);
        expect_end(driven, moves.back().end);
    }
}

/// The section may grow while the start of the next one is planned already.
TEST(TrajectoryGenerator, KeepsAllLimitsWheneverMovesArrive) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const std::vector<Move> moves = program(random);
        const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
        Driven driven(moves, {});
        driven.come = 2;
        double more = 0;
        for (int steps = 0; driven.step(0.001, true); ++steps) {
            ASSERT_LT(steps, 1'000'000);
            if (driven.generator.is_stationary()) driven.pass_time(0.001);
            if (driven.now < more) continue;
            driven.come += 1 + random() % 10;
            more = driven.now + between(0.01, 0.4);
        }
        expect_limits(driven);
        expect_end(driven, moves.back().end);
    }
}

/// The section behind a corner grows when its start is planned already.
TEST(TrajectoryGenerator, ContinuesPastACornerToMovesThatArrivedBeforeIt) {
    std::vector<Move> moves = {line_to({20}, 0.05)};
    for (int i = 1; i <= 80; ++i) moves.push_back(line_to({20 - 0.002 * i * i, 0.4 * i}, 0.01));
    int late = 0;
    for (double left = 0.3; left > 0.01; left -= 0.005) {
        SCOPED_TRACE(left);
        Driven driven(moves, {});
        driven.come = 60;
        while (driven.step(0.001, true)) {
            ASSERT_LT(driven.now, 60);
            if (driven.generator.is_stationary()) driven.pass_time(0.001);
            if (driven.come != 60 || driven.generator.left() > left || driven.now < 0.1) continue;
            late += driven.last.position[1] == 0;
            driven.come = moves.size();
        }
        expect_limits(driven);
        expect_end(driven, moves.back().end);
    }
    EXPECT_GT(late, 10);
}

TEST(TrajectoryGenerator, AppliesOverridesAsSoonAsTheLimitsAllow) {
    Driven driven({long_line(20)}, {});
    const auto velocity_after = [&](double seconds) {
        for (const double until = driven.now + seconds; driven.now < until;) driven.step(0.001, true);
        return driven.generator.at(0).velocity[0];
    };
    EXPECT_NEAR(velocity_after(0.5), 20, 1e-6);
    driven.generator.set_overrides(0.5, 1);
    EXPECT_NEAR(velocity_after(0.15), 10, 1e-6);
    driven.generator.set_overrides(2, 1);
    EXPECT_NEAR(velocity_after(0.2), 40, 1e-6);
    driven.generator.set_overrides(0.01, 1);
    EXPECT_NEAR(velocity_after(0.3), 0.2, 1e-6);
    expect_limits(driven);
}

TEST(TrajectoryGenerator, AlwaysStopsWithinTheMovesItKnows) {
    std::mt19937 random(3);
    const std::vector<Move> moves = program(random);
    Driven driven(moves, {40});
    int looks = 0;
    while (driven.step(0.003, false)) {
        if (driven.generator.is_stationary() || driven.generator.left() < driven.generator.seconds_to_standstill())
            continue;  // the next section starts before the end of this one
        const TrajectoryPoint end = driven.generator.at(driven.generator.seconds_to_standstill());
        for (const double velocity : end.velocity) EXPECT_EQ(velocity, 0);
        ++looks;
    }
    EXPECT_GT(looks, 100);
}

TEST(TrajectoryGenerator, ReportsTheCurrentMoveAndDiscardsPastOnes) {
    std::vector<Move> moves;
    for (int i = 1; i <= 3000; ++i) moves.push_back(line_to({0.3 * i, i % 2 * 0.2}, 0.001));
    Driven driven(moves, {500});
    std::int64_t last = 0;
    while (driven.step(0.02, false)) {
        if (driven.generator.next(false) != NextMotion::motion) continue;
        const std::int64_t number = driven.generator.move_of(driven.generator.at(0));
        EXPECT_GE(number, last);
        EXPECT_EQ(driven.generator.move(number).move.end, moves[static_cast<std::size_t>(number)].end);
        EXPECT_NEAR(driven.generator.at(0).position[0], 0.3 * static_cast<double>(number), 0.7);
        last = number;
    }
    EXPECT_GT(last, 2990);
    EXPECT_EQ(driven.generator.first_pending_move(), 3000);
}

}  // namespace
}  // namespace motionrack::control
