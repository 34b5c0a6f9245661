// A run with known breaches is checked against the limits times their factors, and reports the factors it reached.
#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <tests/invariants/invariants.hpp>
#include <tests/known_breaches.hpp>

namespace motionrack::test {
namespace {

struct Judged {
    bool found = false;
    double peak_accel_factor = 0;
};

/// Checks an axis with 1000 pulses per mm, 1000 mm/s2 and a velocity step of 2 mm/s, which accelerates for 50 ms with
/// 1.9 times its limit.
Judged judge_of_steep_ramp(const LimitFactors& known) {
    Invariants invariants({{'X', false, 1000, 100, 1000, 2}}, {0, milliseconds(12), known}, {});
    Sight now;
    now.axes.resize(1);
    now.state = operate::MachineState::homing;
    for (int i = 0; i <= 25; ++i) {
        const double seconds = i * 0.002;
        now.at = Instant{} + milliseconds(2 * i);
        ++now.sequence;
        now.axes[0].sent = static_cast<std::int64_t>(1000 * 0.5 * 1900 * seconds * seconds);
        now.axes[0].counter = now.axes[0].sent;
        invariants.see(now);
    }
    Judged out;
    for (const Finding& one : invariants.findings()) out.found = out.found || one.rule == Rule::limits_kept;
    out.peak_accel_factor = invariants.peak_accel_factor();
    return out;
}

TEST(KnownBreach, IsAllowedUpToItsFactorAndReported) {
    EXPECT_TRUE(judge_of_steep_ramp({}).found);
    EXPECT_TRUE(judge_of_steep_ramp({1.4, 1}).found);
    const Judged allowed = judge_of_steep_ramp({2, 1});
    EXPECT_FALSE(allowed.found);
    EXPECT_GT(allowed.peak_accel_factor, 1.4) << "the velocity step explains a part";
    EXPECT_LT(allowed.peak_accel_factor, 1.9);
    EXPECT_FALSE(judge_of_steep_ramp({1, 10}).found) << "a step of 20 mm/s in each interval";
}

TEST(KnownBreach, OfRunsWithoutARowFails) {
    EXPECT_EQ(known_breaches("trapezoid").max_velocity_step, 1) << "it has a row for its acceleration only";
    EXPECT_GT(known_breaches("trapezoid").max_accel, 1);
    EXPECT_NONFATAL_FAILURE(known_breaches("trapez"), "has no row for the runs trapez");
}

TEST(KnownBreach, OfTwoKindsOfRunsIsTheLargerOfEachLimit) {
    const LimitFactors both = larger_of({2, 1}, {1, 50});
    EXPECT_EQ(both.max_accel, 2);
    EXPECT_EQ(both.max_velocity_step, 50);
}

}  // namespace
}  // namespace motionrack::test
