// A million profiles against the slow reference solver, a million from outside the limits, and millions against random
// motions. MOTIONRACK_SEED=N sets the first seed, MOTIONRACK_CASES_PERCENT=N a part of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <motionrack/control/axis_profile/test/axis_profile_support.hpp>
#include <tests/environment.hpp>

namespace motionrack::control {
namespace {

using namespace travel_test;

constexpr int parts = 10;

/// Returns the number of tasks in a part.
int tasks_of_a_part() {
    return static_cast<int>(cases("MOTIONRACK_TASKS", 100'000));
}

/// Returns the number of random motions in a part, of which two in five stay within the limits.
int motions_of_a_part() {
    return static_cast<int>(cases("MOTIONRACK_MOTIONS", 1'000'000));
}

class DeepAxisProfiles : public ::testing::TestWithParam<int> {
  protected:
    std::uint64_t seed() const { return seed_from_environment(1000) + static_cast<std::uint64_t>(GetParam()); }
};

double exactness(double seconds) {
    return 1e-8 * std::max(1.0, seconds);
}

TEST_P(DeepAxisProfiles, AreValidAndNeverSlowerThanTheReference) {
    Tasks tasks(seed());
    const int count = tasks_of_a_part();
    int equal = 0;
    for (int i = 0; i < count; ++i) {
        const Task t = i % 2 ? tasks.usual() : tasks.any();
        const auto out = time_optimal_profile(t.from, t.to, t.limits);
        ASSERT_TRUE(out) << text_of(t);
        ASSERT_EQ(fault_of(*out, t), "") << text_of(t);
        const double seconds = out->duration();
        const double referee = slowly_found_duration(t, 200);
        ASSERT_LE(seconds, referee + exactness(seconds)) << text_of(t);
        equal += std::fabs(seconds - referee) <= exactness(seconds);
    }
    // if the reference search misses a motion it is slower, or finds none
    EXPECT_GE(equal, count * 0.995);
    RecordProperty("equal", equal);
}

TEST_P(DeepAxisProfiles, AreNeverSlowerThanRandomMotions) {
    Tasks tasks(seed() + 1000);
    const int count = motions_of_a_part();
    for (int i = 0; i < count; ++i) {
        Task t;
        const auto seconds = tasks.motion(t);
        if (!seconds || *seconds < 1e-3) continue;
        const auto out = time_optimal_profile(t.from, t.to, t.limits);
        ASSERT_TRUE(out) << text_of(t);
        ASSERT_EQ(fault_of(*out, t), "") << text_of(t);
        ASSERT_LE(out->duration(), *seconds + exactness(*seconds)) << text_of(t);
    }
}

TEST_P(DeepAxisProfiles, FromOutsideAreValidAndTimeOptimalOnceWithinTheLimits) {
    Tasks tasks(seed() + 2000);
    const int count = tasks_of_a_part();
    for (int i = 0; i < count; ++i) {
        const Task t = tasks.outside();
        const auto out = time_optimal_profile(t.from, t.to, t.limits);
        ASSERT_TRUE(out) << text_of(t);
        const double entry = entry_of(*out, t.limits);
        ASSERT_EQ(fault_of(*out, t, entry * (1 + 1e-12)), "") << text_of(t);
        const ProfileSample at = out->sample(entry);
        Task rest = t;
        rest.from = {at.position, std::clamp(at.velocity, -t.limits.velocity, t.limits.velocity),
                     std::clamp(at.accel, -t.limits.accel, t.limits.accel)};
        rest.limits.velocity *= 1 + 1e-10;
        const double referee = entry + slowly_found_duration(rest);
        ASSERT_LE(out->duration(), referee + 1e-6 * std::max(1.0, referee)) << text_of(t);
    }
}

INSTANTIATE_TEST_SUITE_P(Part, DeepAxisProfiles, ::testing::Range(0, parts));

}  // namespace
}  // namespace motionrack::control
