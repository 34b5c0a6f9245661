// Tests of laws of S-shaped ramps that do not use the chip's rules: maximum end speed, duration, symmetry of
// acceleration and deceleration, and zero acceleration at the end. The formulas are the maker's; the ramps are the
// chip's.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/ramp.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>
#include <motionrack/cards/mcx314/test/home_rig.hpp>
#include <random>

namespace motionrack::mcx314 {
namespace {

/// Returns a drive with an S-curve and AO at its reset value.
CurveData s_shaped(std::int64_t range, std::int64_t start, std::int64_t top, std::int64_t accel, std::int64_t k,
                   std::int64_t pulses) {
    CurveData data{range, start, top, accel, accel, k, 8};
    data.s_curve = true;
    data.pulses = pulses;
    return data;
}

/// Returns the ticks from one acceleration value to the next.
std::int64_t step_of(const CurveData& data) {
    return 16 * data.K;
}

/// Returns the ticks of a ramp: J = 4 (V - SV) / ta^2 if the acceleration stays below A, otherwise with a straight
/// middle at A.
double ticks_by_the_formula(const CurveData& data) {
    const auto gained = static_cast<double>(data.V - data.SV), accel = static_cast<double>(data.A);
    const double jerk = 1.0 / 64'000 / static_cast<double>(step_of(data));  // speed units a tick, a tick
    const double curved = accel / 64'000 / jerk;
    if (accel / 64'000 * curved >= gained) return 2 * std::sqrt(gained / jerk);
    return gained * 64'000 / accel + curved;
}

/// Returns the maker's sample, "100 to 40,000 pulses/s in 0.4 s", and the sample of another maker.
std::vector<CurveData> examples() {
    const std::int64_t in_400_ms = std::lround(62.5e6 * 10 * 0.4 * 0.4 / (4 * 39'900.0));
    return {s_shaped(800'000, 100, 4'000, 200, 1'010, 50'000), s_shaped(800'000, 10, 4'000, 8'000, in_400_ms, 50'000),
            s_shaped(8'000'000, 400, 4'000, 8'000, 60'000, 20'000)};
}

TEST(SCurveLaw, TheExamplesEndAtTheirInitialSpeed) {
    for (const CurveData& data : examples()) {
        const CurvePlan plan = *plan_drive(data);
        EXPECT_EQ(plan.top_v, data.V) << data.K;
        EXPECT_EQ(plan.end_v, data.SV) << data.K;
        const double formula = ticks_by_the_formula(data);
        EXPECT_NEAR(static_cast<double>(plan.rise.ticks), formula, 0.01 * formula + static_cast<double>(step_of(data)));
        EXPECT_NEAR(static_cast<double>(plan.fall.ticks), formula, 0.01 * formula + static_cast<double>(step_of(data)));
    }
}

TEST(SCurveLaw, AMotorWithAStartFrequency20PercentAboveTheInitialSpeedLosesNoSteps) {
    for (const CurveData& data : examples()) {
        for (const std::optional<std::int64_t> offset :
             {std::optional<std::int64_t>(8), std::optional<std::int64_t>()}) {
            const double start_hz = static_cast<double>(data.SV) * 8e6 / static_cast<double>(data.R);
            HomeRig rig({RigAxis{.start_stop_hz = 1.2 * start_hz}});
            rig.start();
            ASSERT_TRUE(rig.driver.WriteRange(axis_x, data.R));
            ASSERT_TRUE(rig.driver.SetAO(axis_x, offset));
            ASSERT_TRUE(rig.driver.SCurve_F(axis_x, data.SV, data.V, data.A, data.K, *data.pulses));
            ASSERT_TRUE(rig.driver.wait_until_done(axis_x, whole_seconds(60)));
            EXPECT_EQ(rig.machines[0]->lost_steps(), 0) << "K " << data.K << ", AO " << offset.value_or(-1);
            EXPECT_EQ(rig.rotor(), *data.pulses);
        }
    }
}

/// Returns a random ramp of at least ten acceleration values, because a curve of two has no shape.
CurveData any_ramp() {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const auto from = [&](std::int64_t min, std::int64_t max) {
        return std::uniform_int_distribution<std::int64_t>(min, max)(random);
    };
    for (;;) {
        const CurveData data =
            s_shaped(from(16'000, 8'000'000), from(1, 2'000), from(1, 8'000), from(10, 8'000), from(1, 3'000), 0);
        if (data.V > data.SV && ticks_by_the_formula(data) >= 20.0 * static_cast<double>(step_of(data))) return data;
    }
}

RC_GTEST_PROP(SCurveLaw, ARampTakesTheTimeOfTheFormulaAndFallsAsItRose, ()) {
    const CurveData data = any_ramp();
    const rules::Ramp rise = rules::s_ramp(data.SV, data.V, data.A, data.K),
                      fall = rules::s_ramp(data.V, data.SV, data.A, data.K);
    const double formula = ticks_by_the_formula(data), step_ticks = static_cast<double>(step_of(data));
    RC_ASSERT(std::fabs(static_cast<double>(rise.ticks) - formula) <= 0.01 * formula + step_ticks);
    RC_ASSERT(std::fabs(static_cast<double>(fall.ticks) - formula) <= 0.01 * formula + step_ticks);
    RC_ASSERT(std::fabs(static_cast<double>(rise.ticks - fall.ticks)) <= step_ticks);
    // The distance is the mean of the speeds times the time.
    const double mean = 0.5 * static_cast<double>(data.V + data.SV);
    RC_ASSERT(std::fabs(static_cast<double>(rise.phase) - mean * formula) <= 0.02 * mean * formula + mean * step_ticks);
    RC_ASSERT(std::fabs(static_cast<double>(fall.phase) - mean * formula) <= 0.02 * mean * formula + mean * step_ticks);
}

RC_GTEST_PROP(SCurveLaw, WithTheOffsetThatFitsADriveEndsAtItsStartSpeed, ()) {
    CurveData data = any_ramp();
    const auto way = static_cast<double>(data.V + data.SV) * ticks_by_the_formula(data) / static_cast<double>(data.R);
    data.pulses = static_cast<std::int64_t>(way) + *rc::gen::inRange<std::int64_t>(100, 5'000);
    data.AO = *best_offset(data);
    RC_ASSERT(plan_drive(data)->end_v <= data.SV + 1);
}

/// Bits of WR3.
constexpr unsigned s_curve_on = 0x0004;

TEST(SCurveLaw, AccelerationIsZeroAtTheEndOfARamp) {
    using namespace outside;
    for (const std::uint32_t k : {20u, 61u, 300u, 1'010u}) {
        for (const std::uint32_t accel : {12u, 40u, 200u, 8'000u}) {
            Bench b;
            b.start();
            b.speeds(X, 800'000, 100, 4'000);
            b.data(X, 0x01, k);
            b.data(X, 0x02, accel);
            b.mode(X, 3, s_curve_on);
            b.command(X, 0x22);
            while (b.cv(X) < 4'000) b.advance(microseconds(500));
            EXPECT_LE(b.counter(X, 0x13), 1) << "rising, K " << k << ", A " << accel;
            b.data(X, 0x05, 700);
            while (b.cv(X) > 700) b.advance(microseconds(500));
            EXPECT_LE(b.counter(X, 0x13), 1) << "falling, K " << k << ", A " << accel;
        }
    }
}

}  // namespace
}  // namespace motionrack::mcx314
