// Axis profiles: properties at every instant, and time optimality.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/axis_profile/test/axis_profile_support.hpp>

namespace motionrack::control {
namespace {

using namespace travel_test;

double seconds_of(const Task& t) {
    return time_optimal_profile(t.from, t.to, t.limits).value().duration();
}

/// Returns the tolerance for comparing durations, s.
double exactness(double seconds) {
    return 1e-8 * std::max(1.0, seconds);
}

KinematicState state_at(const AxisProfile& travel, double t) {
    const ProfileSample s = travel.sample(t);
    return {s.position, s.velocity, s.accel};
}

TEST(AxisProfile, FromStandstillToStandstillIsTheSCurve) {
    Tasks tasks(1);
    for (int i = 0; i < 3000; ++i) {
        const double velocity = std::fabs(tasks.of_magnitude(1e-2, 1e3)),
                     accel = std::fabs(tasks.of_magnitude(1e-2, 1e3));
        const double jerk = std::fabs(tasks.of_magnitude(1e-2, 1e3)), distance = tasks.of_magnitude(1e-6, 1e4);
        const auto out = time_optimal_profile({}, {distance}, {velocity, accel, jerk});
        ASSERT_TRUE(out);
        const SCurveProfile curve(std::fabs(distance), velocity, accel, jerk);
        ASSERT_NEAR(out->duration(), curve.duration(), 1e-13 * curve.duration()) << i;
        const double t = tasks.part() * curve.duration();
        ASSERT_NEAR(std::fabs(out->sample(t).position), curve.sample(t).position, 1e-12 * std::fabs(distance)) << i;
    }
}

TEST(AxisProfile, KeepsItsLimitsHasNoStepsAndEndsExactly) {
    Tasks tasks(2);
    for (int i = 0; i < 20'000; ++i) {
        const Task t = i % 2 ? tasks.usual() : tasks.any();
        const auto out = time_optimal_profile(t.from, t.to, t.limits);
        ASSERT_TRUE(out) << text_of(t);
        ASSERT_EQ(fault_of(*out, t), "") << text_of(t);
    }
}

TEST(AxisProfile, IsNeverSlowerThanTheReferenceSolution) {
    Tasks tasks(3);
    int equal = 0;
    constexpr int count = 8000;
    for (int i = 0; i < count; ++i) {
        const Task t = i % 2 ? tasks.usual() : tasks.any();
        const double seconds = seconds_of(t), referee = slowly_found_duration(t);
        ASSERT_LE(seconds, referee + exactness(seconds)) << text_of(t);
        equal += std::fabs(seconds - referee) <= exactness(seconds);
    }
    EXPECT_GE(equal, count - count / 100);
}

TEST(AxisProfile, IsNeverSlowerThanARandomMotionToTheSameEnd) {
    Tasks tasks(4);
    for (int i = 0; i < 100'000; ++i) {
        Task t;
        const auto seconds = tasks.motion(t);
        if (seconds && *seconds > 1e-3) {
            ASSERT_LE(seconds_of(t), *seconds + exactness(*seconds)) << text_of(t);
        }
    }
}

TEST(AxisProfile, ReplannedDuringTheMotionTakesTheRemainingTime) {
    Tasks tasks(5);
    for (int i = 0; i < 20'000; ++i) {
        Task t = tasks.usual();
        t.to.velocity = t.to.accel = 0;
        const auto out = time_optimal_profile(t.from, t.to, t.limits);
        ASSERT_TRUE(out);
        const double at = tasks.part() * out->duration();
        t.from = state_at(*out, at);
        ASSERT_NEAR(at + seconds_of(t), out->duration(), 2e-5 * std::max(1.0, out->duration()))
            << text_of(t) << " " << at;
    }
}

/// If rounding makes the remaining time slightly too short for a moving target, only a longer detour reaches it; hence
/// in nearly all cases.
TEST(AxisProfile, ReplannedTowardsAMovingTargetTakesTheRemainingTimeInNearlyAllCases) {
    Tasks tasks(14);
    int longer = 0;
    for (int i = 0; i < 20'000; ++i) {
        Task t = tasks.usual();
        const auto out = time_optimal_profile(t.from, t.to, t.limits);
        ASSERT_TRUE(out);
        const double at = tasks.part() * out->duration();
        t.from = state_at(*out, at);
        longer += at + seconds_of(t) > out->duration() + 1e-5 * std::max(1.0, out->duration());
    }
    EXPECT_LE(longer, 20);
}

TEST(AxisProfile, MirroredTakesTheSameTime) {
    Tasks tasks(6);
    for (int i = 0; i < 5000; ++i) {
        const Task t = i % 2 ? tasks.usual() : tasks.any();
        const auto turned = [](const KinematicState& s) { return KinematicState{-s.position, -s.velocity, -s.accel}; };
        ASSERT_EQ(time_optimal_profile(turned(t.from), turned(t.to), t.limits)->duration(), seconds_of(t))
            << text_of(t);
    }
}

TEST(AxisProfile, ToTheCurrentPositionTakesNoTime) {
    Tasks tasks(7);
    for (int i = 0; i < 2000; ++i) {
        Task t = tasks.usual();
        t.from = t.to;
        ASSERT_EQ(seconds_of(t), 0) << text_of(t);
    }
    const auto out = time_optimal_profile({5, 0, 0}, {5, 0, 0}, {1, 1, 1});
    EXPECT_EQ(out->sample(0).position, 5);
    EXPECT_EQ(out->sample(1).position, 5);
    EXPECT_TRUE(out->phases().empty());
}

TEST(AxisProfile, StartsAndEndsAtItsLimits) {
    const KinematicLimits limits = {2, 1, 4};
    const double signs[] = {-1, 0, 1};
    for (const double v : signs)
        for (const double a : signs)
            for (const double w : signs)
                for (const double b : signs)
                    for (const double distance : {-40.0, -3.0, -1e-9, 0.0, 1e-9, 0.5, 25.0}) {
                        // a velocity that is just feasible with its acceleration
                        const auto kept = [&](double velocity, double accel) {
                            return 2 * velocity - velocity * accel * accel * 0.125;
                        };
                        const Task t = {{0, kept(v, a), a}, {distance, kept(w, b), b}, limits};
                        const auto out = time_optimal_profile(t.from, t.to, t.limits);
                        ASSERT_TRUE(out) << text_of(t);
                        ASSERT_EQ(fault_of(*out, t), "") << text_of(t);
                        ASSERT_LE(out->duration(), slowly_found_duration(t, 2000) + 1e-8) << text_of(t);
                    }
}

TEST(AxisProfile, AcceptsLimitsAMillionTimesApart) {
    Tasks tasks(8);
    for (const double velocity : {1e-6, 1.0, 1e6})
        for (const double accel : {1e-6, 1.0, 1e6})
            for (const double jerk : {1e-6, 1.0, 1e6})
                for (const double distance : {1e-9, 1e-3, 1.0, 1e3, 1e9})
                    for (int i = 0; i < 20; ++i) {
                        Task t = tasks.usual();
                        t.limits = {velocity, accel, jerk};
                        t.from = {0, velocity * tasks.between(-0.5, 0.5), 0};
                        t.to = {tasks.one_in(2) ? distance : -distance, velocity * tasks.between(-0.5, 0.5), 0};
                        const auto out = time_optimal_profile(t.from, t.to, t.limits);
                        ASSERT_TRUE(out) << text_of(t);
                        ASSERT_EQ(fault_of(*out, t), "") << text_of(t);
                        const double referee = slowly_found_duration(t);
                        ASSERT_LE(out->duration(), referee + exactness(referee)) << text_of(t);
                    }
}

TEST(AxisProfile, ReversesIfItMust) {
    // at full velocity past a position just ahead: it overshoots, returns and stops
    const KinematicLimits limits = {10, 20, 100};
    const auto out = time_optimal_profile({0, 10, 0}, {1, 0, 0}, limits);
    double farthest = 0;
    for (int i = 0; i <= 1000; ++i) farthest = std::max(farthest, out->sample(out->duration() * i / 1000).position);
    EXPECT_NEAR(farthest, stop_profile({0, 10, 0}, limits)->target().position, 0.2);
    EXPECT_EQ(out->sample(out->duration()).position, 1);
}

TEST(AxisProfile, FromOutsideReturnsWithinTheLimitsAndIsTimeOptimalFromThere) {
    Tasks tasks(9);
    for (int i = 0; i < 3000; ++i) {
        Task t = tasks.outside();
        const auto out = time_optimal_profile(t.from, t.to, t.limits);
        ASSERT_TRUE(out) << text_of(t);
        const double entry = entry_of(*out, t.limits);
        ASSERT_EQ(fault_of(*out, t, entry * (1 + 1e-12)), "") << text_of(t);
        if (entry == 0) continue;
        if (i % 4 == 0) {
            const double referee = slowly_found_entry(t.from, t.limits);
            ASSERT_NEAR(entry, referee, 1e-5 * referee + 1e-8) << text_of(t);
        }
        Task rest = t;
        rest.from = state_at(*out, entry);
        rest.from.velocity = std::clamp(rest.from.velocity, -t.limits.velocity, t.limits.velocity);
        rest.from.accel = std::clamp(rest.from.accel, -t.limits.accel, t.limits.accel);
        rest.limits.velocity *= 1 + 1e-10;
        ASSERT_LE(out->duration(), entry + slowly_found_duration(rest) + 1e-6 * std::max(1.0, out->duration()))
            << text_of(t);
    }
}

TEST(AxisProfile, IsRejectedForAnInfeasibleEndState) {
    const KinematicLimits limits = {2, 4, 8};
    EXPECT_TRUE(time_optimal_profile({}, {1, 2, 0}, limits));
    EXPECT_TRUE(time_optimal_profile({}, {1, 1, 4}, limits));
    EXPECT_FALSE(time_optimal_profile({}, {1, 2.001, 0}, limits));
    EXPECT_FALSE(time_optimal_profile({}, {1, 0, 4.001}, limits));
    EXPECT_FALSE(time_optimal_profile({}, {1, 1.001, 4}, limits));
    EXPECT_FALSE(time_optimal_profile({}, {1, 1.001, -4}, limits));
    EXPECT_FALSE(velocity_change_profile({}, -2.001, 0, limits));
    EXPECT_TRUE(is_feasible_end(-1, 4, limits));
    EXPECT_FALSE(is_feasible_end(-1.001, 4, limits));
}

TEST(AxisProfile, IsRejectedForNotANumber) {
    const KinematicLimits limits = {2, 4, 8};
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        for (const KinematicState& state :
             {KinematicState{bad, 0, 0}, KinematicState{0, bad, 0}, KinematicState{0, 0, bad}}) {
            EXPECT_FALSE(time_optimal_profile(state, {1}, limits));
            EXPECT_FALSE(time_optimal_profile({}, state, limits));
            EXPECT_FALSE(stop_profile(state, limits));
            EXPECT_FALSE(velocity_change_profile(state, 1, 0, limits));
        }
        EXPECT_FALSE(velocity_change_profile({}, bad, 0, limits));
        EXPECT_FALSE(velocity_change_profile({}, 0, bad, limits));
        for (const KinematicLimits& of_none :
             {KinematicLimits{bad, 1, 1}, KinematicLimits{1, bad, 1}, KinematicLimits{1, 1, bad}})
            EXPECT_FALSE(time_optimal_profile({}, {1}, of_none));
    }
    for (const double bad : {0.0, -1.0})
        for (const KinematicLimits& of_none :
             {KinematicLimits{bad, 1, 1}, KinematicLimits{1, bad, 1}, KinematicLimits{1, 1, bad}})
            EXPECT_FALSE(time_optimal_profile({}, {1}, of_none));
}

TEST(VelocityChangeProfile, HoldsItsLimitsAndEndsExactly) {
    Tasks tasks(10);
    for (int i = 0; i < 20'000; ++i) {
        Task t = i % 2 ? tasks.usual() : tasks.any();
        const auto out = velocity_change_profile(t.from, t.to.velocity, t.to.accel, t.limits);
        ASSERT_TRUE(out) << text_of(t);
        t.to.position = out->target().position;
        ASSERT_EQ(fault_of(*out, t), "") << text_of(t);
    }
}

TEST(VelocityChangeProfile, IsTheFastestOfAllProfilesToItsVelocity) {
    Tasks tasks(11);
    for (int i = 0; i < 40'000; ++i) {
        Task t = i % 2 ? tasks.usual() : tasks.any();
        std::optional<double> seconds;
        if (i % 4 == 3) seconds = tasks.motion(t);
        const double min_duration =
            velocity_change_profile(t.from, t.to.velocity, t.to.accel, t.limits).value().duration();
        if (i % 4 != 3) seconds = seconds_of(t);
        if (seconds) {
            ASSERT_LE(min_duration, *seconds + 1e-7 * std::max(1.0, *seconds)) << text_of(t);
        }
    }
}

/// A velocity change is itself a motion to its final position, so the time-optimal profile to that position is not
/// slower; and no motion changes the velocity sooner.
TEST(VelocityChangeProfile, EqualsTheProfileToItsEndPosition) {
    Tasks tasks(12);
    for (int i = 0; i < 20'000; ++i) {
        Task t = i % 2 ? tasks.usual() : tasks.any();
        const auto out = velocity_change_profile(t.from, t.to.velocity, t.to.accel, t.limits);
        t.to = out.value().target();
        ASSERT_NEAR(seconds_of(t), out->duration(), exactness(out->duration())) << text_of(t);
    }
}

TEST(StopProfile, EndsAtStandstillAndEqualsTheVelocityChangeToZero) {
    Tasks tasks(13);
    for (int i = 0; i < 5000; ++i) {
        const Task t = tasks.outside();
        const auto out = stop_profile(t.from, t.limits);
        ASSERT_TRUE(out);
        EXPECT_EQ(out->target().velocity, 0);
        EXPECT_EQ(out->target().accel, 0);
        EXPECT_EQ(out->duration(), velocity_change_profile(t.from, 0, 0, t.limits)->duration());
        const ProfileSample before = out->sample(out->duration() * (1 - 1e-12));
        EXPECT_NEAR(before.position, out->target().position, 1e-9 * (1 + std::fabs(before.position))) << text_of(t);
        EXPECT_NEAR(before.velocity, 0,
                    1e-9 * std::max({t.limits.velocity, std::fabs(t.from.velocity),
                                     t.from.accel * t.from.accel / t.limits.jerk}))
            << text_of(t);
    }
}

/// The number was the same with g++ and clang++ at -O0, -O2 and -O3.
TEST(AxisProfile, BitsAreTheSameOnEveryCompilerAndCpu) {
    EXPECT_EQ(bits_of_travels(20261122, 20'000), 17850973485159433083u);
}

}  // namespace
}  // namespace motionrack::control
