// Compares plans with the virtual chip: every pulse must come at its planned tick.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <motionrack/cards/mcx314/driver/curves.hpp>
#include <motionrack/cards/mcx314/test/driver_rig.hpp>
#include <vector>

namespace motionrack::mcx314 {
namespace {

/// Returns the planned ticks of the pulses, counted from the command.
std::vector<std::int64_t> planned_pulses(const CurveData& data, CurvePlan& plan) {
    std::vector<std::int64_t> out;
    plan = *plan_drive(data, [&](const CurveSpan& span) {
        // Pulse m of the span is at the first tick at which the accumulator has passed m times R.
        for (std::int64_t m = 1;; ++m) {
            const std::int64_t ticks = rules::ceil_div(m * data.R - span.at, span.v);
            if (ticks > span.ticks) break;
            out.push_back(span.tick + ticks);
        }
    });
    return out;
}

/// Returns the ticks of the pulses of the same drive on the chip; a continuous drive is stopped at its speed, as in
/// plan_drive().
std::vector<std::int64_t> made_pulses(const CurveData& data) {
    DriverRig rig(true, Duration{0});
    Driver& d = rig.driver;
    EXPECT_TRUE(d.WriteRange(axis_x, data.R));
    EXPECT_TRUE(d.SetSV(axis_x, data.SV));
    EXPECT_TRUE(d.SetV(axis_x, data.V));
    EXPECT_TRUE(d.SetA(axis_x, data.A));
    EXPECT_TRUE(d.SetD(axis_x, data.D));
    EXPECT_TRUE(d.SetAA(axis_x, data.K));
    EXPECT_TRUE(d.SetAO(axis_x, data.AO));
    EXPECT_TRUE(d.Pulse(axis_x, *data.pulses));
    if (data.dec_point) {
        EXPECT_TRUE(d.ManualDec(axis_x, *data.dec_point));
    }
    EXPECT_TRUE(d.SetAsymmetric(axis_x, data.asymmetric));
    d.SetSCurve(axis_x, data.s_curve);
    const std::int64_t command = rig.kernel.now() / outside::tick;
    d.Drive(axis_x, false);
    EXPECT_TRUE(d.wait_until_stopped(axis_x, whole_seconds(4'000)));
    rig.deliver_edges();
    std::vector<std::int64_t> out;
    for (const outside::EdgeLog::Edge& edge : rig.edges[0].list) out.push_back(edge.tick - command);
    return out;
}

void expect_same(const CurveData& data) {
    CurvePlan plan;
    const std::vector<std::int64_t> planned = planned_pulses(data, plan);
    ASSERT_EQ(planned, made_pulses(data));
    EXPECT_EQ(plan.pulses, *data.pulses);
    if (planned.empty()) return;
    EXPECT_EQ(plan.ticks, planned.back());
    EXPECT_EQ(plan.rise.pulses + plan.cruise.pulses + plan.fall.pulses + plan.creep.pulses, plan.pulses);
    EXPECT_EQ(rules::start_ticks + plan.rise.ticks + plan.cruise.ticks + plan.fall.ticks + plan.creep.ticks,
              plan.ticks);
}

TEST(Curves, MakeThePulsesOfTheChip) {
    const CurveData trapezoid{8'000'000 / 100, 10, 800, 400, 400, 65'535, 0};
    for (const std::int64_t pulses : {0, 1, 2, 3, 10, 500, 777, 3'000}) {
        CurveData data = trapezoid;
        data.pulses = pulses;
        SCOPED_TRACE(pulses);
        expect_same(data);
        data.AO = 8;
        expect_same(data);
        data.s_curve = true;
        data.K = 30;
        expect_same(data);
        data.A = 90;  // A is reached, so the middle of the ramps is straight
        expect_same(data);
        data.asymmetric = true;
        data.D = 50;
        expect_same(data);
        data.dec_point = pulses / 2;
        expect_same(data);
        data.s_curve = false;
        expect_same(data);
    }
}

TEST(Curves, MakeThePulsesOfTheChipWhateverTheParameters) {
    EXPECT_TRUE(rc::check([] {
        CurveData data;
        data.R = *rc::gen::inRange<std::int64_t>(16'000, 800'000);
        data.SV = *rc::gen::oneOf(rc::gen::inRange<std::int64_t>(1, 50), rc::gen::inRange<std::int64_t>(1, 8'001));
        data.V = *rc::gen::inRange<std::int64_t>(1, 8'001);
        data.A = *rc::gen::oneOf(rc::gen::inRange<std::int64_t>(1, 100), rc::gen::inRange<std::int64_t>(1, 8'001));
        data.D = *rc::gen::inRange<std::int64_t>(1, 8'001);
        data.K = *rc::gen::oneOf(rc::gen::inRange<std::int64_t>(1, 50), rc::gen::inRange<std::int64_t>(1, 20'000));
        data.AO = *rc::gen::inRange<std::int64_t>(0, 20);
        data.s_curve = *rc::gen::arbitrary<bool>();
        data.asymmetric = *rc::gen::arbitrary<bool>();
        data.pulses = *rc::gen::oneOf(rc::gen::inRange<std::int64_t>(0, 50), rc::gen::inRange<std::int64_t>(0, 6'000));
        if (*rc::gen::arbitrary<bool>()) data.dec_point = *rc::gen::inRange<std::int64_t>(0, *data.pulses + 10);
        CurvePlan plan;
        const std::vector<std::int64_t> planned = planned_pulses(data, plan);
        RC_ASSERT(planned == made_pulses(data));
        RC_ASSERT(plan.pulses == *data.pulses);
    }));
}

TEST(Curves, TheBestDecelerationPointIsTheLatestThatEndsAtTheInitialSpeed) {
    EXPECT_TRUE(rc::check([] {
        CurveData data;
        data.R = *rc::gen::inRange<std::int64_t>(16'000, 8'000'000);
        data.SV = *rc::gen::inRange<std::int64_t>(1, 500);
        data.V = *rc::gen::inRange<std::int64_t>(1, 8'001);
        data.A = *rc::gen::inRange<std::int64_t>(1, 8'001);
        data.D = *rc::gen::inRange<std::int64_t>(1, 8'001);
        data.K = *rc::gen::inRange<std::int64_t>(1, 2'000);
        data.s_curve = *rc::gen::arbitrary<bool>();
        data.asymmetric = true;
        data.pulses = *rc::gen::inRange<std::int64_t>(0, 100'000);
        const std::int64_t point = *best_dec_point(data);
        data.dec_point = point;
        RC_ASSERT(plan_drive(data)->ends_slow());
        if (point < *data.pulses) {
            data.dec_point = point + 1;
            RC_ASSERT(!plan_drive(data)->ends_slow());
        }
    }));
}

TEST(Curves, TheBestOffsetIsTheMinimumThatEndsAtTheInitialSpeed) {
    EXPECT_TRUE(rc::check([] {
        CurveData data;
        data.R = *rc::gen::inRange<std::int64_t>(16'000, 8'000'000);
        data.SV = *rc::gen::inRange<std::int64_t>(1, 500);
        data.V = *rc::gen::inRange<std::int64_t>(1, 8'001);
        data.A = *rc::gen::inRange<std::int64_t>(1, 8'001);
        data.K = *rc::gen::inRange<std::int64_t>(1, 2'000);
        data.s_curve = *rc::gen::arbitrary<bool>();
        data.pulses = *rc::gen::inRange<std::int64_t>(0, 60'000);
        data.AO = *best_offset(data);
        RC_ASSERT(plan_drive(data)->ends_slow());
        if (data.AO > 0) {
            --data.AO;
            RC_ASSERT(!plan_drive(data)->ends_slow());
        }
    }));
}

TEST(Curves, ASlowStopIsPlannedForAContinuousDrive) {
    CurveData data{80'000, 10, 800, 400, 200, 65'535, 0};
    data.asymmetric = true;
    const CurvePlan plan = *plan_drive(data);
    EXPECT_EQ(plan.top_v, 800);
    EXPECT_EQ(plan.rise.ticks, 790 * 64'000 / 400);
    EXPECT_EQ(plan.fall.ticks, 790 * 64'000 / 200);
    EXPECT_EQ(plan.fall.to_v, 10);
    EXPECT_NEAR(static_cast<double>(plan.fall.pulses), 2.0 * static_cast<double>(plan.rise.pulses), 3);
    EXPECT_NEAR(static_cast<double>(fall_pulses(data, 800)), static_cast<double>(plan.fall.pulses), 1);
    EXPECT_EQ(speed_after_fall(data, 800, fall_pulses(data, 800)), 10);
    EXPECT_GT(speed_after_fall(data, 800, 100), 700);
}

// ---- published numbers

TEST(Curves, TheDocumentedTrapezoidHasTheTimesOfItsFormulas) {
    // R = 800,000 (M = 10), A = D = 200: 250,000 pulses/s2 from 1,000 to 40,000 pulses/s: 0.156 s and 3,198 pulses each
    // way.
    CurveData data{800'000, 100, 4'000, 200, 200, 65'535, 0};
    data.pulses = 80'000;
    const CurvePlan plan = *plan_drive(data);
    EXPECT_NEAR(to_seconds(plan.rise.time()), 0.156, 1e-6);
    EXPECT_NEAR(to_seconds(plan.fall.time()), 0.156, 0.002) << "the last pulse at 1,000 pulses/s is up to 1 ms early";
    EXPECT_NEAR(static_cast<double>(plan.rise.pulses), 3'198, 1);
    EXPECT_NEAR(static_cast<double>(plan.cruise.pulses), 73'604, 2);
    EXPECT_NEAR(to_seconds(plan.time()), 2.1521, 0.002);
    EXPECT_DOUBLE_EQ(plan.peak_acceleration(plan.rise), 250'000);
    EXPECT_TRUE(plan.reaches_v);
    data.pulses = 40'000;
    EXPECT_NEAR(to_seconds(plan_drive(data)->time()), 1.1521, 0.002);
}

TEST(Curves, TheDocumentedSCurveStaysBelowItsMaximumAcceleration) {
    // K = 1,010, M = 10: jerk 618,812; SV 1,000, V 40,000 pulses/s: peak 155,350 pulses/s2, 0.50209 s, 10,292.9 pulses.
    CurveData data{800'000, 100, 4'000, 200, 200, 1'010, 0};
    data.s_curve = true;
    data.pulses = 50'000;
    const CurvePlan plan = *plan_drive(data);
    EXPECT_NEAR(plan.jerk(), 618'812, 1);
    EXPECT_TRUE(plan.full_s);
    EXPECT_NEAR(plan.peak_acceleration(plan.rise), 155'350, 1'250);
    EXPECT_NEAR(to_seconds(plan.rise.time()), 0.50209, 0.004);
    EXPECT_NEAR(static_cast<double>(plan.rise.pulses), 10'292.9, 60);
}

TEST(Curves, TheExamplesOfACompatibleChipAgree) {
    // SV = 1,000, V = 5,000, A = D = 1,500, P = 20,000 at M = 1: 187,500 pulses/s2, 0.02133 s, 64 pulses each way.
    CurveData fast{8'000'000, 1'000, 5'000, 1'500, 1'500, 65'535, 0};
    fast.pulses = 20'000;
    const CurvePlan plan = *plan_drive(fast);
    EXPECT_NEAR(to_seconds(plan.rise.time()), 0.02133, 1e-4);
    EXPECT_NEAR(static_cast<double>(plan.rise.pulses), 64, 1);
    EXPECT_NEAR(static_cast<double>(plan.fall.pulses), 64, 1);
    // S-curve with A = 8,000, K = 60,000: 3.718 s, 8,180 pulses.
    CurveData smooth{8'000'000, 400, 4'000, 8'000, 8'000, 60'000, 0};
    smooth.s_curve = true;
    smooth.pulses = 20'000;
    const CurvePlan s = *plan_drive(smooth);
    EXPECT_NEAR(s.jerk(), 1'041.67, 0.01);
    EXPECT_TRUE(s.full_s);
    EXPECT_NEAR(to_seconds(s.rise.time()), 3.718, 0.01 * 3.718);
    EXPECT_NEAR(static_cast<double>(s.rise.pulses), 8'180, 0.03 * 8'180) << "its acceleration has only 15 steps";
    EXPECT_LT(s.rise.pulses, 10'000);
    // Manual deceleration after 15,000 of 20,000 pulses.
    CurveData manual{8'000'000, 400, 4'000, 1'500, 1'500, 65'535, 0};
    manual.pulses = 20'000;
    manual.dec_point = 15'000;
    const CurvePlan m = *plan_drive(manual);
    EXPECT_EQ(m.rise.pulses + m.cruise.pulses, 15'000);
    EXPECT_TRUE(m.ends_slow());
    EXPECT_EQ(m.pulses, 20'000);
}

TEST(Curves, AreRefusedOutsideTheRanges) {
    CurveData data{80'000, 10, 800, 400, 400, 65'535, 0};
    data.pulses = -1;
    EXPECT_FALSE(plan_drive(data));
    EXPECT_FALSE(best_dec_point(data));
    data.pulses.reset();
    EXPECT_TRUE(plan_drive(data));
    EXPECT_FALSE(best_dec_point(data));
    data.V = 0;
    EXPECT_FALSE(plan_drive(data));
    data.V = 1;
    data.R = 15'999;
    const auto refused = plan_drive(data);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("16000"), std::string::npos);
}

}  // namespace
}  // namespace motionrack::mcx314
