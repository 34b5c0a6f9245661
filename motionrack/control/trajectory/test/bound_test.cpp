// Jerk-limited trajectories compared with the minimum duration: never faster, and only slightly slower on smooth shapes
// in short chords.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/path/test/path_builder_support.hpp>
#include <motionrack/control/trajectory/min_duration.hpp>
#include <motionrack/control/trajectory/test/offline_trajectory_support.hpp>
#include <motionrack/control/trajectory/test/oracle.hpp>
#include <tests/environment.hpp>

namespace motionrack::control {
namespace {

using curve_test::line_to;
using curve_test::machine;
using curve_test::ProgramMaker;

MachineLimits with_jerk(double jerk) {
    MachineLimits limits = machine();
    for (AxisLimits& axis : limits) axis.max_jerk = jerk, axis.pulses_per_unit = 10'000;
    return limits;
}

// ---- shapes in chords

std::vector<Move> circle(double chord, double radius = 20) {
    std::vector<Move> out;
    const int count = static_cast<int>(2 * pi * radius / chord);
    for (int i = 1; i <= count; ++i) {
        const SinCos at = sin_cos(2 * pi * i / count);
        out.push_back(line_to({radius * at.sin, radius - radius * at.cos}));
    }
    return curve_test::numbered(out);
}

std::vector<Move> sine(double chord) {
    std::vector<Move> out;
    for (int i = 1; i * chord <= 100; ++i) out.push_back(line_to({i * chord, 8 * sin_cos(i * chord * 0.2).sin}));
    return curve_test::numbered(out);
}

std::vector<Move> spiral(double chord) {
    std::vector<Move> out;
    for (double angle = 0; angle < 8 * pi;) {
        angle += chord / (3 + angle);
        const SinCos at = sin_cos(angle);
        out.push_back(line_to({(3 + angle) * at.cos - 3, (3 + angle) * at.sin}));
    }
    return curve_test::numbered(out);
}

std::vector<Move> at_feed(std::vector<Move> moves, double feed) {
    for (Move& move : moves) move.feed = feed;
    return moves;
}

struct Seconds {
    double offline_trajectory = 0, bound = 0, referee = 0;
};

Seconds seconds_of(const std::vector<Move>& moves, const MachineLimits& limits, int of_piece = 20) {
    Seconds out;
    for (const trajectory_test::KeptStretch& kept : trajectory_test::kept_trajectory(moves, limits)) {
        out.offline_trajectory += kept.section.seconds;
        out.bound += min_duration_s(kept.curve, limits);
        out.referee += trajectory_test::time_optimal_s(kept.curve, limits, of_piece);
    }
    return out;
}

TEST(AccelBound, OfALineIsItsTrapezoid) {
    const MachineLimits limits = machine();
    const auto bound = [&](const Move& move) { return seconds_of({move}, limits).bound; };
    Move slow = line_to({50, 0}), traverse = line_to({30, 40});
    traverse.kind = MoveKind::rapid;
    EXPECT_NEAR(bound(slow), 50.0 / 100 + 100.0 / 2000, 1e-12);  // distance / velocity + velocity / acceleration
    EXPECT_NEAR(bound(traverse), 40.0 / 200 + 200.0 / 2000, 1e-12);
    EXPECT_NEAR(bound(line_to({0, 2})), 2 * std::sqrt(2.0 / 2000), 1e-12);
    EXPECT_EQ(min_duration_s({}, limits), 0);
}

/// No axis can pass the circle faster than sqrt(2 acceleration radius); at sqrt(acceleration radius) both can hold the
/// velocity.
TEST(AccelBound, OfACircleIsNearTheVelocityOfItsCurvature) {
    const MachineLimits limits = with_jerk(1e6);
    const double seconds = seconds_of(at_feed(circle(0.1), 1e4), limits).bound;
    EXPECT_LT(seconds, 1.02 * (2 * pi * 20 / std::sqrt(2000.0 * 20) + 200.0 / 2000));
    EXPECT_GT(seconds, 2 * pi * 20 / 283.0);
}

/// The reference checks both ends of its steps, the bound the middle of its cells: the true value is near both.
TEST(AccelBound, EqualsTheReference) {
    const MachineLimits limits = with_jerk(1e6);
    for (const double feed : {100.0, 1000.0})
        for (const double chord : {0.1, 0.25})
            for (const auto& shape : {circle(chord), sine(chord), spiral(chord)}) {
                const Seconds found = seconds_of(at_feed(shape, feed), limits);
                EXPECT_NEAR(found.bound / found.referee, 1, 3e-4) << chord << " " << feed;
            }
    for (std::uint64_t seed = 1; seed <= 15; ++seed) {
        const Seconds found = seconds_of(ProgramMaker(seed).program(3), machine());
        EXPECT_NEAR(found.bound / found.referee, 1, 2e-3) << seed;
    }
}

/// Chords that are too long for a smooth curvature bend the curve in steps; there the two differ more.
TEST(AccelBound, IsNearTheReferenceForChangingCurvature) {
    const MachineLimits limits = with_jerk(1e6);
    for (const double feed : {100.0, 1000.0})
        for (const auto& shape : {circle(1), sine(1), spiral(1)}) {
            const Seconds found = seconds_of(at_feed(shape, feed), limits, 60);
            EXPECT_LE(found.bound / found.referee, 1 + 1e-4) << feed;
            EXPECT_GE(found.bound / found.referee, 1 - 6e-3) << feed;
        }
}

TEST(AccelBound, IsNotShorterWithTighterLimits) {
    MachineLimits limits = machine();
    const std::vector<Move> moves = ProgramMaker(8).program(4);
    double last = 0;
    for (int i = 0; i < 6; ++i) {
        const double seconds = seconds_of(moves, limits, 1).bound;
        EXPECT_GE(seconds, last * (1 - 1e-3)) << i;
        last = seconds;
        limits[static_cast<std::size_t>(i) % 3].max_accel *= 0.5;
    }
}

TEST(AccelBound, HasTheSameBitsOnEveryCompilerAndCpu) {
    std::uint64_t fold = 0;
    for (const auto& shape : {circle(0.7), sine(0.25), spiral(1)})
        fold = (fold ^ std::bit_cast<std::uint64_t>(
                           min_duration_s(curve_test::pieces_of(curve_test::curve_of(shape)), machine()))) *
               0x9E3779B97F4A7C15u;
    EXPECT_EQ(fold, 17139071396192919648u);
}

TEST(OfflineTrajectory, IsNeverFasterThanItsLowerBound) {
    for (const double jerk : {1e3, 1e6})
        for (const double chord : {0.1, 0.25, 1.0})
            for (const auto& shape : {circle(chord), sine(chord), spiral(chord)}) {
                const Seconds found = seconds_of(shape, with_jerk(jerk));
                EXPECT_GE(found.offline_trajectory, found.referee * (1 - 1e-3)) << jerk << " " << chord;
            }
    const std::uint64_t count = trials("MOTIONRACK_PROGRAMS", 6, 40);
    for (std::uint64_t seed = 1; seed <= count; ++seed)
        for (const trajectory_test::KeptStretch& kept :
             trajectory_test::kept_trajectory(ProgramMaker(seed).program(4), machine()))
            EXPECT_GE(kept.section.seconds, trajectory_test::time_optimal_s(kept.curve, machine(), 60) * (1 - 1e-3))
                << seed;
}

struct Nearness {
    const char* name;
    std::vector<Move> moves;
    double at_feed, as_fast_as_can_be;  ///< relative to the minimum duration
};

/// The jerk limit is so high that it costs no time. At the feed rate the loss is at the ends and on curves that are
/// tighter than the feed rate allows. Without a feed rate the loss is where the velocity changes on curves, because a
/// limit applies to a part of the curve at its tightest point. Long chords have an intermittent curvature.
TEST(OfflineTrajectory, IsNearItsLowerBoundOnSmoothShapes) {
    const std::vector<Nearness> shapes = {
        {"circle 0.1", circle(0.1), 1.0015, 1.011}, {"circle 0.25", circle(0.25), 1.0015, 1.011},
        {"circle 1", circle(1), 1.001, 1.011},      {"sine 0.1", sine(0.1), 1.008, 1.023},
        {"sine 0.25", sine(0.25), 1.007, 1.023},    {"sine 1", sine(1), 1.032, 1.055},
        {"spiral 0.1", spiral(0.1), 1.001, 1.008},  {"spiral 0.25", spiral(0.25), 1.001, 1.008},
        {"spiral 1", spiral(1), 1.009, 1.036}};
    const MachineLimits limits = with_jerk(1e8);
    for (const Nearness& shape : shapes) {
        const Seconds fed = seconds_of(shape.moves, limits), free = seconds_of(at_feed(shape.moves, 1000), limits);
        EXPECT_LE(fed.offline_trajectory, shape.at_feed * fed.referee) << shape.name;
        EXPECT_LE(free.offline_trajectory, shape.as_fast_as_can_be * free.referee) << shape.name;
    }
}

}  // namespace
}  // namespace motionrack::control
