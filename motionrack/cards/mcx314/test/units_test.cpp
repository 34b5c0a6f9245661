// Tests of physical units: results are as near to the request as the registers allow, and the stated rounding is true.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <limits>
#include <motionrack/cards/mcx314/driver/real_axis.hpp>
#include <motionrack/cards/mcx314/test/driver_rig.hpp>

namespace motionrack::mcx314 {
namespace {

double any(double min, double max) {
    const double part = static_cast<double>(*rc::gen::inRange<std::int64_t>(0, 1'000'001)) / 1e6;
    return min + (max - min) * part;
}

/// Checks that a register value is at most half a unit off, unless it is at the end of its range.
void near(const Rounded& value, double unit, std::int64_t min, std::int64_t max) {
    RC_ASSERT(value.value >= min);
    RC_ASSERT(value.value <= max);
    RC_ASSERT(std::fabs(value.real - static_cast<double>(value.value) * unit) <= 1e-9 * value.real);
    if (value.value > min && value.value < max) RC_ASSERT(std::fabs(value.real - value.asked) <= unit * 0.5000001);
}

/// Returns the smallest relative excess over a speed (pulses/s) of any V, with any R up to `widest`.
double least_excess(double speed, double widest) {
    double out = std::numeric_limits<double>::infinity();
    for (double v = 1; v <= 8'000; ++v) {
        const double range = std::min(std::floor(8e6 * v / speed), widest);
        if (range >= 16'000) out = std::min(out, 8e6 * v / range / speed - 1);
    }
    return out;
}

TEST(Units, ChoosesTheWidestSufficientRangeAndReachesTheRequestedSpeed) {
    EXPECT_TRUE(rc::check([] {
        const Scale scale{any(0.1, 10'000)};
        RealDrive drive;
        const double pulses = scale.pulses_per_unit;
        drive.speed = any(10, 4e6) / pulses;
        drive.start_speed = any(1, 4e6) / pulses;
        drive.acceleration = any(125, 5e8) / pulses;
        drive.deceleration = *rc::gen::arbitrary<bool>() ? any(125, 5e8) / pulses : 0;
        drive.jerk = *rc::gen::arbitrary<bool>() ? any(1'000, 31.25e9) / pulses : 0;
        const auto set = real_setting(scale, drive);
        RC_ASSERT(set.has_value());
        const double multiple = 8e6 / static_cast<double>(set->R), unit = multiple / pulses;
        RC_ASSERT(set->R >= 16'000);
        RC_ASSERT(set->R <= 8'000'000);
        near(set->speed, unit, 1, 8'000);
        near(set->start_speed, unit, 1, 8'000);
        near(set->acceleration, 125 * unit, 1, 8'000);
        near(set->deceleration, 125 * unit, 1, 8'000);
        if (set->s_curve) RC_ASSERT(set->jerk.value >= 1 && set->jerk.value <= 65'535);
        const double min_multiple = std::max({1.0, drive.speed * pulses / 8'000, drive.start_speed * pulses / 8'000,
                                              drive.acceleration * pulses / 1e6, drive.deceleration * pulses / 1e6,
                                              drive.jerk * pulses / 62.5e6});
        // The set speed exceeds the request by at most one step of R; if no V and R allow that, it is as near as
        // possible.
        const double excess = least_excess(drive.speed * pulses, std::floor(8e6 / min_multiple));
        RC_ASSERT(set->speed.error() <= std::max(excess, 1.0 / 15'999) + 1e-9);
        RC_ASSERT(set->speed.error() >= -std::max(excess - 1.0 / 15'999, 0.0) - 1e-9);
        // Every requested value is within the range of its register.
        for (const Rounded* value : {&set->start_speed, &set->acceleration, &set->deceleration})
            RC_ASSERT(value->value < 8'000 || value->error() > -1e-4);
        // A multiple finer by 1/4,000 would not suffice: V, or another value, would exceed its range, or the range is
        // at its end.
        if (set->speed.value > 1'000) RC_ASSERT(multiple <= min_multiple * 1.0012);
    }));
}

TEST(Units, RegistersConvertBackToTheGivenValues) {
    EXPECT_TRUE(rc::check([] {
        const Scale scale{any(1, 1'000)};
        const RealDrive drive{any(1, 300), any(0.1, 5), any(10, 900), any(10, 900),
                              *rc::gen::arbitrary<bool>() ? any(100, 9'000) : 0};
        const auto set = real_setting(scale, drive);
        RC_ASSERT(set.has_value());
        const RealDrive back = real_values(scale, set->curve());
        auto same = [](double a, double b) { return std::fabs(a - b) <= 1e-9 * std::fabs(b); };
        RC_ASSERT(same(back.speed, set->speed.real));
        RC_ASSERT(same(back.start_speed, set->start_speed.real));
        RC_ASSERT(same(back.acceleration, set->acceleration.real));
        if (set->asymmetric) RC_ASSERT(same(back.deceleration, set->deceleration.real));
        RC_ASSERT(same(back.jerk, set->jerk.real));
        // The conversion of the real values finds the same register values at the same R.
        const auto again = real_setting_at(scale, back, set->R);
        RC_ASSERT(again.has_value());
        RC_ASSERT(again->speed.value == set->speed.value);
        RC_ASSERT(again->acceleration.value == set->acceleration.value);
        RC_ASSERT(again->start_speed.value == set->start_speed.value);
        RC_ASSERT(again->jerk.value == set->jerk.value);
    }));
}

/// Compares the conversions with the scaling table: R, M, and the meaning of 1 and of the maximum of each register.
TEST(Units, MatchesTheScalingTable) {
    struct Row {
        std::int64_t r;
        double v1, v8000, a1, a8000, k65535, k1;
    };
    for (const Row& row :
         {Row{8'000'000, 1, 8'000, 125, 1e6, 954, 62.5e6}, Row{800'000, 10, 80'000, 1'250, 1e7, 9'537, 625e6},
          Row{80'000, 100, 800'000, 12'500, 1e8, 95'369, 6.25e9},
          Row{16'000, 500, 4e6, 62'500, 5e8, 476'844, 31.25e9}}) {
        CurveData low{row.r, 1, 1, 1, 1, 65'535}, high{row.r, 1, 8'000, 8'000, 8'000, 1};
        low.s_curve = high.s_curve = true;
        EXPECT_DOUBLE_EQ(real_values({1}, low).speed, row.v1);
        EXPECT_DOUBLE_EQ(real_values({1}, high).speed, row.v8000);
        EXPECT_DOUBLE_EQ(real_values({1}, low).acceleration, row.a1);
        EXPECT_DOUBLE_EQ(real_values({1}, high).acceleration, row.a8000);
        EXPECT_NEAR(real_values({1}, low).jerk, row.k65535, 1);
        EXPECT_DOUBLE_EQ(real_values({1}, high).jerk, row.k1);
    }
}

TEST(Units, TheTextStatesEveryRounding) {
    const auto set = real_setting({200}, {33.3, 1, 400, 300, 5'000});
    ASSERT_TRUE(set);
    const std::string text = set->text();
    for (const char* part : {"R ", "speed 33.3 -> V ", "start speed 1 -> SV ", "acceleration 400 -> A ",
                             "deceleration 300 -> D ", "jerk 5000 -> K "})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_NEAR(set->max_error(), 0.0078, 0.0001) << "K is a small number: " << text;
}

TEST(Units, AnAxisMovesInMillimetresAsPlanned) {
    for (const RealDrive& drive :
         {RealDrive{50, 2, 400}, RealDrive{50, 2, 400, 150}, RealDrive{50, 2, 400, 0, 8'000}}) {
        DriverRig rig;
        RealAxis axis(rig.driver, 1, {200}, {400});
        ASSERT_TRUE(axis.set(drive));
        const auto plan = axis.plan(12.3456);
        ASSERT_TRUE(plan);
        EXPECT_TRUE(plan->reaches_speed);
        EXPECT_NEAR(plan->top_speed, 50, 0.01);
        EXPECT_NEAR(plan->end_speed, 2, 0.01);
        EXPECT_NEAR(plan->distance, 12.345, 1e-9);
        EXPECT_NEAR(plan->rise.distance + plan->cruise.distance + plan->fall.distance + plan->creep.distance, 12.345,
                    1e-9);
        const Instant begin = rig.kernel.now();
        const auto moved = axis.move(12.3456);
        ASSERT_TRUE(moved);
        EXPECT_NEAR(moved->real, 12.345, 1e-9);
        EXPECT_EQ(moved->value, 2'469);
        ASSERT_TRUE(rig.driver.wait_until_done(axis_y, whole_seconds(10)));
        EXPECT_NEAR(to_seconds(rig.kernel.now() - begin), plan->seconds, 0.001);
        EXPECT_NEAR(axis.position(), 12.345, 1e-9);
        ASSERT_TRUE(axis.move_to(-1));
        ASSERT_TRUE(rig.driver.wait_until_done(axis_y, whole_seconds(10)));
        EXPECT_NEAR(axis.position(), -1, 1e-9);
        ASSERT_TRUE(axis.set_position(100));
        ASSERT_TRUE(axis.run(true));
        rig.port.pass(milliseconds(500));
        EXPECT_NEAR(*axis.speed(), -50, 0.01);
        EXPECT_FALSE(axis.change_speed(4'000));
        EXPECT_TRUE(axis.change_speed(20));
        rig.port.pass(milliseconds(500));
        EXPECT_NEAR(*axis.speed(), -20, 0.02);
        ASSERT_TRUE(rig.driver.stop(axis_y, StopKind::slow));
        ASSERT_TRUE(rig.driver.wait_until_done(axis_y, whole_seconds(10)));
        EXPECT_LT(axis.position(), 80);
        // Moves the end during the move, relative to its start.
        const double from = axis.position();
        ASSERT_TRUE(axis.move(50));
        while (!rig.driver.axis_status(1).constant()) rig.port.pass(milliseconds(1));
        const auto back = axis.change_distance(-1);
        ASSERT_FALSE(back);
        EXPECT_NE(back.error().message.find("cannot reverse"), std::string::npos) << back.error().message;
        EXPECT_FALSE(axis.change_distance(0.1)) << "it is beyond that";
        const auto nearer = axis.change_distance(30.0012);
        ASSERT_TRUE(nearer) << nearer.error().message;
        EXPECT_NEAR(nearer->real, 30, 1e-9);
        ASSERT_TRUE(rig.driver.wait_until_done(axis_y, whole_seconds(10)));
        EXPECT_NEAR(axis.position(), from + 30, 1e-9);
    }
}

}  // namespace
}  // namespace motionrack::mcx314
