// Trapezoidal and double-S profiles: cases by hand, exact ends, limits, symmetry, and time optimality within their
// form.

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/rest_profiles.hpp>
#include <random>

namespace motionrack::control {
namespace {

/// Limits over many decades, from a seed.
struct Limits {
    double distance, velocity, accel, jerk, entry, exit;
};

Limits random_limits(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto decades = [&random](double low, double high) {
        return std::pow(10.0, std::uniform_real_distribution<double>(low, high)(random));
    };
    Limits limits{};
    limits.distance = decades(-6, 5);
    limits.velocity = decades(-2, 4);
    limits.accel = decades(-1, 5);
    limits.jerk = decades(0, 7);
    limits.entry = limits.velocity * std::uniform_real_distribution<double>(0, 1)(random);
    limits.exit = limits.velocity * std::uniform_real_distribution<double>(0, 1)(random);
    return limits;
}

void near(double got, double expected, double scale) {
    RC_ASSERT(std::fabs(got - expected) <= 1e-11 * scale);
}

/// Compares velocities at instants whose resolution is limited by a double of `duration`.
void near_velocity(double got, double expected, double velocity, double accel, double duration) {
    near(got, expected, velocity + 1e-4 * accel * duration);
}

TEST(TrapezoidalProfile, ALongDistanceHasAllThreePhases) {
    const TrapezoidalProfile p(100, 20, 50);
    EXPECT_DOUBLE_EQ(p.peak(), 20);
    EXPECT_DOUBLE_EQ(p.duration(), 100.0 / 20 + 20.0 / 50);
    EXPECT_DOUBLE_EQ(p.phase_ends()[0], 0.4);
    EXPECT_DOUBLE_EQ(p.phase_ends()[1], 5);
    EXPECT_DOUBLE_EQ(p.sample(0.2).position, 1);
    EXPECT_DOUBLE_EQ(p.sample(0.2).velocity, 10);
    EXPECT_DOUBLE_EQ(p.sample(0.2).accel, 50);
    EXPECT_DOUBLE_EQ(p.sample(2.7).position, 50);
    EXPECT_EQ(p.sample(2.7).accel, 0);
    EXPECT_DOUBLE_EQ(p.sample(5.2).position, 99);
    EXPECT_DOUBLE_EQ(p.sample(5.2).accel, -50);
}

TEST(TrapezoidalProfile, AShortDistanceIsATriangle) {
    const TrapezoidalProfile p(2, 20, 50);
    EXPECT_DOUBLE_EQ(p.peak(), 10);
    EXPECT_DOUBLE_EQ(p.duration(), 0.4);
    EXPECT_DOUBLE_EQ(p.sample(0.2).position, 1);
}

TEST(TrapezoidalProfile, ZeroDistanceTakesNoTime) {
    const TrapezoidalProfile p(0, 20, 50);
    EXPECT_EQ(p.duration(), 0);
    EXPECT_EQ(p.sample(0).position, 0);
    EXPECT_EQ(SCurveProfile(0, 1, 1, 1).duration(), 0);
    EXPECT_EQ(SCurveProfile(0, 1, 1, 1).sample(1).position, 0);
}

TEST(TrapezoidalProfile, ConnectsEntryAndExitVelocity) {
    const TrapezoidalProfile p(10, 5, 15, 20, 50);
    EXPECT_EQ(p.entry(), 5);
    EXPECT_EQ(p.exit(), 15);
    EXPECT_DOUBLE_EQ(p.peak(), 20);
    EXPECT_DOUBLE_EQ(p.phase_ends()[0], 0.3);
    EXPECT_DOUBLE_EQ(p.duration() - p.phase_ends()[1], 0.1);
    EXPECT_DOUBLE_EQ(p.sample(0).velocity, 5);
    EXPECT_DOUBLE_EQ(p.sample(p.duration()).velocity, 15);
}

TEST(TrapezoidalProfile, ReachesTheNearestExitVelocityIfTheDistanceIsTooShort) {
    const TrapezoidalProfile up(1, 3, 100, 100, 8);
    EXPECT_DOUBLE_EQ(up.exit(), 5);
    EXPECT_DOUBLE_EQ(up.duration(), 0.25);
    EXPECT_DOUBLE_EQ(up.sample(0.125).position, 0.4375);
    const TrapezoidalProfile down(1, 5, 0, 100, 8);
    EXPECT_DOUBLE_EQ(down.exit(), 3);
    EXPECT_DOUBLE_EQ(down.duration(), 0.25);
    EXPECT_DOUBLE_EQ(down.sample(0.125).position, 0.5625);
}

RC_GTEST_PROP(TrapezoidLaws, PhasesAddUpToTheDistanceAndTheExitVelocity, ()) {
    const Limits l = random_limits(*rc::gen::arbitrary<std::uint64_t>());
    const TrapezoidalProfile p(l.distance, l.entry, l.exit, l.velocity, l.accel);
    double t = 0;
    double position = 0;
    double velocity = p.entry();
    for (const double end : p.phase_ends()) {
        const double dt = end - t;
        const double accel = dt > 0 ? p.sample(t + 0.5 * dt).accel : 0;
        near(p.sample(t).position, position, l.distance + l.velocity * p.duration());
        position += dt * (velocity + 0.5 * accel * dt);
        velocity += accel * dt;
        t = end;
    }
    near(position, l.distance, l.distance + l.velocity * p.duration());
    near_velocity(velocity, p.exit(), l.velocity, l.accel, p.duration());
    RC_ASSERT(p.sample(p.duration()).position == l.distance);
    RC_ASSERT(p.sample(p.duration() * 2).position == l.distance);
}

RC_GTEST_PROP(TrapezoidLaws, NeverPassesALimitNorGoesBack, ()) {
    const Limits l = random_limits(*rc::gen::arbitrary<std::uint64_t>());
    const TrapezoidalProfile p(l.distance, l.entry, l.exit, l.velocity, l.accel);
    double last = 0;
    for (int k = 0; k <= 300; ++k) {
        const ProfileSample s = p.sample(p.duration() * k / 300);
        RC_ASSERT(s.velocity >= 0);
        RC_ASSERT(s.velocity <= l.velocity * (1 + 1e-12));
        RC_ASSERT(std::fabs(s.accel) <= l.accel);
        RC_ASSERT(s.position >= last - 1e-12 * l.distance);
        RC_ASSERT(s.position <= l.distance * (1 + 1e-12));
        last = s.position;
    }
}

RC_GTEST_PROP(TrapezoidLaws, NoOtherPeakVelocityIsQuicker, ()) {
    const Limits l = random_limits(*rc::gen::arbitrary<std::uint64_t>());
    const TrapezoidalProfile p(l.distance, l.entry, l.exit, l.velocity, l.accel);
    const double v0 = p.entry();
    const double v1 = p.exit();
    const double low = std::max(v0, v1);
    double min_duration = 1e300;
    for (int k = 0; k <= 4000; ++k) {
        const double v = low + (l.velocity - low) * k / 4000;
        const double ramps = (2 * v * v - v0 * v0 - v1 * v1) / (2 * l.accel);
        if (v == 0 || ramps > l.distance * (1 + 1e-12)) continue;
        min_duration = std::min(min_duration, (2 * v - v0 - v1) / l.accel + (l.distance - ramps) / v);
    }
    // velocities have a resolution of 1e-16 of their value, which the reference converts to times
    RC_ASSERT(p.duration() <= min_duration * (1 + 1e-9) + 1e-15 * l.velocity / l.accel);
}

TEST(SCurveProfile, ALongDistanceHasAllSevenPhases) {
    const SCurveProfile p(100, 20, 50, 500);
    EXPECT_DOUBLE_EQ(p.peak(), 20);
    EXPECT_DOUBLE_EQ(p.peak_accel(), 50);
    EXPECT_DOUBLE_EQ(p.duration(), 100.0 / 20 + 20.0 / 50 + 50.0 / 500);
    const auto ends = p.phase_ends();
    EXPECT_DOUBLE_EQ(ends[0], 0.1);
    EXPECT_DOUBLE_EQ(ends[1], 0.4);
    EXPECT_DOUBLE_EQ(ends[2], 0.5);
    EXPECT_DOUBLE_EQ(ends[3], 5);
    EXPECT_DOUBLE_EQ(ends[6], 5.5);
    EXPECT_DOUBLE_EQ(p.sample(0.05).jerk, 500);
    EXPECT_DOUBLE_EQ(p.sample(0.25).accel, 50);
    EXPECT_DOUBLE_EQ(p.sample(0.45).jerk, -500);
    EXPECT_DOUBLE_EQ(p.sample(2.75).position, 50);
    EXPECT_DOUBLE_EQ(p.sample(5.05).jerk, -500);
    EXPECT_DOUBLE_EQ(p.sample(5.25).accel, -50);
    EXPECT_DOUBLE_EQ(p.sample(5.45).jerk, 500);
}

TEST(SCurveProfile, ShortDistancesMatchTheTextbookCases) {
    // full acceleration, not full velocity: v^2 / a + v a / j = d with a 50, j 500 and v 10 gives d 3
    const SCurveProfile no_cruise(3, 20, 50, 500);
    EXPECT_DOUBLE_EQ(no_cruise.peak(), 10);
    EXPECT_DOUBLE_EQ(no_cruise.duration(), 0.6);
    // neither: d = 2 j t^3 with t 0.05
    const SCurveProfile jerk_only(0.125, 20, 50, 500);
    EXPECT_NEAR(jerk_only.peak_accel(), 25, 1e-13);
    EXPECT_NEAR(jerk_only.duration(), 0.2, 1e-15);
    // full velocity without full acceleration: t = sqrt(v / j) = 0.1
    const SCurveProfile slow(10, 5, 1000, 500);
    EXPECT_DOUBLE_EQ(slow.peak_accel(), 50);
    EXPECT_DOUBLE_EQ(slow.duration(), 2 + 0.2);
}

RC_GTEST_PROP(SCurveLaws, PhasesAddUpToTheDistanceAtRest, ()) {
    const Limits l = random_limits(*rc::gen::arbitrary<std::uint64_t>());
    const SCurveProfile p(l.distance, l.velocity, l.accel, l.jerk);
    const auto ends = p.phase_ends();
    const double rise = ends[0];
    const double level = std::max(0.0, ends[2] - 2 * rise);
    const double lasts[7] = {rise, level, rise, ends[3] - ends[2], rise, level, rise};
    const double signs[7] = {1, 0, -1, 0, -1, 0, 1};
    double position = 0;
    double velocity = 0;
    double accel = 0;
    for (int i = 0; i < 7; ++i) {
        const double begins = i == 0 ? 0 : ends[static_cast<std::size_t>(i - 1)];
        const double dt = lasts[i];
        near(p.sample(begins).position, position, l.distance);
        near_velocity(p.sample(begins).velocity, velocity, p.peak(), p.peak_accel(), p.duration());
        if (dt > 1e-9 * p.duration()) RC_ASSERT(p.sample(begins + 0.5 * dt).jerk == signs[i] * l.jerk);
        const double jerk = signs[i] * l.jerk;
        position += dt * (velocity + dt * (0.5 * accel + dt * jerk / 6));
        velocity += dt * (accel + 0.5 * jerk * dt);
        accel += jerk * dt;
    }
    near(position, l.distance, l.distance);
    near(velocity, 0, p.peak());
    near(accel, 0, p.peak_accel());
    RC_ASSERT(p.sample(p.duration()).position == l.distance);
    RC_ASSERT(p.sample(p.duration()).velocity == 0);
}

RC_GTEST_PROP(SCurveLaws, NeverPassesALimitNorGoesBackAndIsSymmetric, ()) {
    const Limits l = random_limits(*rc::gen::arbitrary<std::uint64_t>());
    const SCurveProfile p(l.distance, l.velocity, l.accel, l.jerk);
    double last = 0;
    for (int k = 0; k <= 300; ++k) {
        const double t = p.duration() * k / 300;
        const ProfileSample s = p.sample(t);
        RC_ASSERT(s.velocity >= -1e-13 * l.velocity);
        RC_ASSERT(s.velocity <= l.velocity * (1 + 1e-12));
        RC_ASSERT(std::fabs(s.accel) <= l.accel * (1 + 1e-12));
        RC_ASSERT(std::fabs(s.jerk) <= l.jerk);
        RC_ASSERT(s.position >= last - 1e-12 * l.distance);
        last = s.position;
        const ProfileSample mirror = p.sample(p.duration() - t);
        near(mirror.position, l.distance - s.position, l.distance);
        near_velocity(mirror.velocity, s.velocity, p.peak(), p.peak_accel(), p.duration());
        if (k > 0 && k < 300) near(mirror.accel, -s.accel, p.peak_accel() + 1e-4 * l.jerk * p.duration());
    }
}

/// Returns the duration of the profile with these limits and peak velocity v, or a large number if the distance is too
/// short.
double seconds_with(double distance, double v, double accel, double jerk) {
    const double accel_duration = v * jerk >= accel * accel ? v / accel + accel / jerk : 2 * std::sqrt(v / jerk);
    if (v * accel_duration > distance * (1 + 1e-12)) return 1e300;
    return accel_duration + distance / v;
}

RC_GTEST_PROP(SCurveLaws, NoOtherPeaksAreQuicker, ()) {
    const Limits l = random_limits(*rc::gen::arbitrary<std::uint64_t>());
    const SCurveProfile p(l.distance, l.velocity, l.accel, l.jerk);
    double min_duration = 1e300;
    for (int k = 1; k <= 4000; ++k) {
        min_duration = std::min(min_duration, seconds_with(l.distance, l.velocity * k / 4000, l.accel, l.jerk));
        min_duration = std::min(min_duration, seconds_with(l.distance, p.peak() * k / 4000, l.accel, l.jerk));
    }
    for (int k = 1; k <= 60; ++k) {
        for (int m = 1; m <= 60; ++m) {
            const double accel = l.accel * k / 60;
            min_duration = std::min(min_duration, seconds_with(l.distance, p.peak() * m / 60, accel, l.jerk));
            min_duration = std::min(min_duration, seconds_with(l.distance, p.peak() * m / 60, accel, l.jerk * 0.7));
        }
    }
    RC_ASSERT(std::fabs(p.duration() - min_duration) <= 1e-9 * min_duration);
}

TEST(CubeRoot, IsWithinAFewRoundingsOverTheWholeRange) {
    for (double x = 1e-307; x < 1e307; x *= 1.37) {
        const auto truth = static_cast<double>(std::cbrt(static_cast<long double>(x)));
        ASSERT_NEAR(cube_root(x), truth, 7e-16 * truth) << x;
    }
    EXPECT_EQ(cube_root(0), 0);
    EXPECT_NEAR(cube_root(27), 3, 2e-15);
}

}  // namespace
}  // namespace motionrack::control
