// Feed hold during execution: a prompt stop, on the path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/trajectory/test/driven.hpp>
#include <motionrack/control/trajectory/test/offline_trajectory_support.hpp>
#include <random>
#include <vector>

namespace motionrack::control {
namespace {

using trajectory_test::arc_from;
using trajectory_test::Driven;
using trajectory_test::expect_end;
using trajectory_test::expect_limits;
using trajectory_test::line_to;
using trajectory_test::long_line;
using trajectory_test::machine;
using trajectory_test::program;

/// The path to the stop may have corners, curves and the end of the known path. If a section has started before the
/// previous one has ended, the generator executes both as planned until the previous one ends.
TEST(TrajectoryGeneratorDisturbedAtRandom, NeverAcceleratesAgainOnceItDeceleratesForAFeedHold) {
    for (unsigned seed = 0; seed < 40; ++seed) {
        std::mt19937 random(seed);
        const std::vector<Move> moves = program(random);
        const double whole = trajectory_test::trajectory_seconds(moves, machine());
        for (int holds = 0; holds < 10; ++holds) {
            const double when = whole * std::uniform_real_distribution<>(0, 1)(random);
            SCOPED_TRACE(::testing::Message() << "seed " << seed << ", held at " << when << " s");
            Driven driven(moves, {64});
            while (driven.now < when && driven.step(0.001, true)) {
            }
            driven.generator.hold();
            double peak_velocity = 0, min_velocity = 1e9, rise = 0;  // the last two: since the deceleration began
            while (driven.generator.next(true) == NextMotion::motion) {
                const TrajectoryPoint before = driven.last;
                const double at = driven.now;
                driven.step(0.001, true);
                const double way = driven.last.u - before.u;
                if (driven.now - at < 0.0005) continue;  // too short to measure a velocity
                if (at - when < 0.02 || way < 0) {       // no effect yet, or in the next section
                    peak_velocity = 0, min_velocity = 1e9;
                    continue;
                }
                const double velocity = way / (driven.now - at);
                peak_velocity = std::max(peak_velocity, velocity);
                if (velocity < 0.98 * peak_velocity) min_velocity = std::min(min_velocity, velocity);
                rise = std::max(rise, velocity - 1.05 * min_velocity);
            }
            EXPECT_LT(rise, 0.1);
            EXPECT_LT(driven.now - when, 1);
            expect_limits(driven);
        }
    }
}

TEST(TrajectoryGenerator, StopsSoonAfterFeedHoldAndResumesFromThere) {
    Driven driven({long_line(50)}, {});
    while (driven.now < 0.5) driven.step(0.001, true);
    driven.generator.hold();
    const double asked = driven.now;
    while (driven.generator.next(true) == NextMotion::motion) driven.step(0.001, true);
    // twice sqrt(velocity / jerk): the acceleration limit is not reached
    EXPECT_NEAR(driven.now - asked, 2 * std::sqrt(50 / machine()[0].max_jerk), 0.005);
    EXPECT_TRUE(driven.generator.is_stationary());
    EXPECT_EQ(driven.generator.next(true), NextMotion::nothing);
    driven.generator.resume();
    while (driven.step(0.001, true)) {
    }
    EXPECT_NEAR(driven.last.position[0], 100, 1e-6);
    expect_limits(driven);
}

/// Returns a line, the same line in short ones, a circle, and the same circle in chords.
std::vector<std::vector<Move>> ways_at(double feed) {
    std::vector<std::vector<Move>> out = {{long_line(feed)}, {}, {arc_from({}, 0, 30, 6)}, {}};
    for (int i = 1; i <= 200; ++i) out[1].push_back(line_to({0.5 * i}));
    for (int i = 1; i <= 600; ++i)
        out[3].push_back(line_to({30 * std::sin(0.01 * i), 30 - 30 * std::cos(0.01 * i)}, 0.02));
    for (std::vector<Move>& way : out)
        for (Move& move : way) move.feed = feed;
    return out;
}

TEST(TrajectoryGenerator, StopsAsEarlyWhileDeceleratingForOverrides) {
    for (const std::vector<Move>& way : ways_at(50)) {
        const auto held_after = [&](double feed, double after) {
            Driven driven(way, {});
            while (driven.now < 0.5) driven.step(0.001, true);
            driven.generator.set_overrides(feed, 1);
            while (driven.now < 0.5 + after) driven.step(0.001, true);
            driven.generator.hold();
            const double asked = driven.now;
            while (driven.generator.next(true) == NextMotion::motion) driven.step(0.001, true);
            expect_limits(driven);
            return driven.now - asked;
        };
        const double alone = held_after(1, 0);
        for (const double feed : {0.8, 0.4, 0.1, 0.02})
            for (double after = 0.001; after < 1.2 * alone; after += 0.006)
                EXPECT_LT(held_after(feed, after), alone + 0.03)
                    << way.size() << " moves, feed " << feed << ", held " << after << " s after";
    }
}

/// The curvature alone uses nearly all of the acceleration of X and Y alternately, and most of their jerk; the
/// deceleration needs both as well.
TEST(TrajectoryGenerator, StopsEarlyOnACircleAtItsMaxVelocity) {
    Move circle = arc_from({}, 0, 10, 50);
    circle.feed = 1000;
    for (const double when : {0.8, 0.9, 1.0, 1.1, 1.2}) {
        Driven driven({circle}, {});
        while (driven.now < when) driven.step(0.001, true);
        const double velocity = std::hypot(driven.last.velocity[0], driven.last.velocity[1]),
                     all = std::sqrt(machine()[0].max_accel * 10);
        EXPECT_GT(velocity, 0.9 * all);
        driven.generator.hold();
        const double asked = driven.now,
                     alone = velocity / machine()[0].max_accel + machine()[0].max_accel / machine()[0].max_jerk;
        while (driven.generator.next(true) == NextMotion::motion) driven.step(0.001, true);
        EXPECT_LT(driven.now - asked, 4 * alone) << when;
        expect_limits(driven);
    }
}

/// Holds during acceleration, and at full velocity, where hardly any jerk remains for deceleration.
TEST(TrajectoryGenerator, StopsAndDeceleratesEarlyOnCurvesThatNeedNearlyTheFullJerk) {
    const auto velocity_of = [](const Driven& driven) {
        return std::hypot(driven.last.velocity[0], driven.last.velocity[1]);
    };
    for (const double radius : {2, 10})
        for (double when = 0.05; when < 0.6; when += 0.05) {
            SCOPED_TRACE(::testing::Message() << "radius " << radius << ", at " << when << " s");
            Move circle = arc_from({}, 0, radius, 50);
            circle.feed = 1000;
            Driven held({circle}, {}), slowed({circle}, {});
            while (held.now < when) held.step(0.001, true);
            while (slowed.now < when) slowed.step(0.001, true);
            const double velocity = velocity_of(held);
            held.generator.hold();
            while (held.generator.next(true) == NextMotion::motion) held.step(0.001, true);
            EXPECT_LT(held.now - when, 0.5);
            slowed.generator.set_overrides(0.5 * velocity / circle.feed, 1);
            while (velocity_of(slowed) > 0.51 * velocity && slowed.now < when + 1) slowed.step(0.001, true);
            EXPECT_LT(slowed.now - when, 0.8);
            expect_limits(held);
            expect_limits(slowed);
        }
}

/// Without the hold the next line would start before this one has ended.
TEST(TrajectoryGenerator, StopsAtTheCornerAfterAFeedHoldJustBeforeIt) {
    Driven driven({line_to({10, 0}, 0.2), line_to({10, 10}, 0.2)}, {});
    driven.step(0, true);
    const double whole = driven.generator.seconds_to_standstill();
    while (driven.generator.left() > 0.005) ASSERT_TRUE(driven.step(0.0005, true));
    ASSERT_LT(driven.now, 0.8 * whole);
    driven.generator.hold();
    while (!driven.generator.is_stationary()) driven.step(0.0005, true);
    EXPECT_NEAR(driven.last.position[0], 10, 1e-3);
    EXPECT_NEAR(driven.last.position[1], 0, 1e-3);
    driven.generator.resume();
    while (driven.step(0.0005, true)) {
    }
    expect_limits(driven);
    expect_end(driven, {10, 10});
}

}  // namespace
}  // namespace motionrack::control
