// Tests of lines, arcs, chains and patterns of the function library on a virtual chip: ends, speeds, and refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/cards/mcx314/test/driver_checks.hpp>
#include <motionrack/cards/mcx314/test/driver_rig.hpp>

namespace motionrack::mcx314 {
namespace {

using testing::HasSubstr;

TEST(DriverPaths, ArcsWithATrapezoidEndAtTheirInitialSpeed) {
    for (const std::int64_t decel : {0, 300})
        for (const bool clockwise : {false, true}) {
            DriverRig rig(true);
            Driver& d = rig.driver;
            done(d.SetMultiple(xyzu, 10));
            const CIRCLEDATA data{20, 1'000, 800, decel, {3'000, clockwise ? -3'000 : 3'000}, {3'000, 0}};
            done(clockwise ? d.CircleCCW_T(data, 0x3) : d.CircleCW_T(data, 0x3));
            done(d.wait_until_done(0x3, max_wait));
            EXPECT_EQ(d.ReadLPS(0), 3'000);
            rig.deliver_edges();
            // At the end X is the axis that steps at each basic pulse.
            EXPECT_NEAR(last_rate(rig.edges[0], 1), 200, 60);
            EXPECT_GT(last_rate(rig.edges[0], 100), 400) << "and does not creep";
        }
}

TEST(DriverPaths, AnAsymmetricLineEndsAtItsInitialSpeed) {
    DriverRig rig(true);
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.Line2D_T({20, 1'000, 800, 200, 0, {9'000, -4'000}}, 0x3));
    done(d.wait_until_done(0x3, max_wait));
    rig.deliver_edges();
    EXPECT_NEAR(last_rate(rig.edges[0], 1), 200, 40);
    EXPECT_GT(last_rate(rig.edges[0], 100), 400);
}

TEST(DriverPaths, AChainKeepsItsSpeedAtJunctionsAndDeceleratesInItsLastSegment) {
    DriverRig rig(true);
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.ContStart({20, 800, 400, 0}));
    for (int i = 0; i < 5; ++i) done(d.ContLine(0x3, {1'000, i % 2 == 0 ? 300 : -300}, i == 2 ? 400 : 0));
    done(d.ContArc(0x3, {2'000, 2'000}, {0, 2'000}, false));
    const Result<ContOutcome> outcome = d.ContEnd(max_wait);
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_EQ(outcome->segments, 6);
    EXPECT_EQ(outcome->end_speed, 20);
    EXPECT_EQ(d.ReadLPS(0), 7'000);
    EXPECT_EQ(d.ReadLPS(1), 2'300);
    rig.deliver_edges();
    const auto& x = rig.edges[0].list;
    for (std::size_t i = 1'200; i < 1'900; ++i) EXPECT_LE(x[i].tick - x[i - 1].tick, 1'001) << i;  // 8,000 pulses/s
    for (std::size_t i = 2'800; i < 5'000; ++i)
        EXPECT_LE(x[i].tick - x[i - 1].tick, 2'001) << i;  // 4,000 pulses/s from segment 3 on
    for (std::size_t i = 2'800; i < 5'000; ++i) EXPECT_GE(x[i].tick - x[i - 1].tick, 1'999) << i;
    EXPECT_NEAR(last_rate(rig.edges[1], 1), 200, 60);
}

TEST(DriverPaths, ATooShortLastSegmentOfAChainLowersTheSpeedOfTheSegmentsBefore) {
    DriverRig rig(true);
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.ContStart({20, 800, 400, 0}));
    done(d.ContLine(0x3, {3'000, 0}));
    done(d.ContLine(0x3, {50, 10}));
    const Result<ContOutcome> outcome = d.ContEnd(max_wait);
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_EQ(outcome->end_speed, 20);
    rig.deliver_edges();
    EXPECT_NEAR(last_rate(rig.edges[0], 1), 200, 60);
    // Without a segment long enough for the deceleration, the result reports the end speed.
    done(d.ContStart({20, 800, 800, 0}));
    done(d.ContLine(0x3, {3'000, 0}));
    done(d.ContLine(0x3, {3, 1}));
    done(d.ContLine(0x3, {3, 1}));
    done(d.ContLine(0x3, {3, 1}));
    const Result<ContOutcome> fast = d.ContEnd(max_wait);
    ASSERT_TRUE(fast) << fast.error().message;
    EXPECT_GT(fast->end_speed, 20);
}

TEST(DriverPaths, AChainThatALimitStopsReportsIt) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.ContStart({0, 800, 0, 0}));
    done(d.ContLine(0x3, {30'000, 0}));
    done(d.ContLine(0x3, {1'000, 10}));
    rig.port.pass(milliseconds(200));
    rig.wire("xlmtp", 0);
    rig.port.pass(milliseconds(1));
    const Result<void> stopped = d.ContLine(0x3, {1'000, 10});
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::machine);
    EXPECT_THAT(stopped.error().message, HasSubstr("The chain was stopped. X stands at LP"));
    EXPECT_THAT(stopped.error().message, HasSubstr("the + limit switch was reached"));
    EXPECT_FALSE(d.ContEnd(max_wait));
}

TEST(DriverPaths, ALineEndsAnOpenChainOrPattern) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.BP2D({0, 100, 0, 0}, 0x3));
    done(d.BPStack({{0xFFFF, 0xFFFF}, {0, 0}}));
    done(d.Line2D_C({0, 500, 0, 0, 0, {0, 0, 300, 200}}, 0xC));
    done(d.wait_until_done(0xC, max_wait));
    EXPECT_FALSE(d.BPStart());
    EXPECT_FALSE(d.moving(xyzu));
    EXPECT_EQ(d.ReadLPS(0), 0);

    done(d.ContStart({20, 800, 400, 0}));
    done(d.ContLine(0x3, {9'000, 0}));
    done(d.ContLine(0x3, {9'000, 0}));
    rig.port.pass(milliseconds(100));
    EXPECT_FALSE(d.Line2D_T({10, 500, 100, 0, 0, {0, 0, 300, 200}}, 0xC)) << "it would be queued";
    done(d.stop(axis_x, StopKind::slow));
    done(d.wait_until_stopped(xyzu, max_wait));
    done(d.Line2D_T({10, 500, 100, 0, 0, {0, 20'000, 5'000}}, 0x6));
    rig.port.pass(milliseconds(500));
    done(d.change_speed(axis_y, 100));  // Y is the main axis of the line, not the chain's X
    EXPECT_FALSE(d.ContLine(0x3, {9'000, 0}));
    done(d.stop(axis_y, StopKind::quick));
}

TEST(DriverPaths, UnknownSpeedsAreNotReported) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.CircleCCW_C({0, 100, 0, 0, {}, {-20'000, 0}}, 0x3));
    ASSERT_TRUE(d.axis_speeds());
    done(d.LPS(axis_y, 500));
    const auto moved = d.axis_speeds();
    ASSERT_FALSE(moved);
    EXPECT_THAT(moved.error().message, HasSubstr("LPS moved a counter"));
    d.stop_all(StopKind::quick);
    done(d.BP2D({0, 100, 0, 0}, 0x3));
    for (int i = 0; i < 3; ++i) done(d.BPStack({{0xFFFF, 0xFFFF}, {0, 0}}));
    done(d.BPStart());
    const auto pattern = d.axis_speeds();
    ASSERT_FALSE(pattern);
    EXPECT_THAT(pattern.error().message, HasSubstr("a bit pattern runs"));
    done(d.stop(axis_x, StopKind::quick));
}

TEST(DriverPaths, ALateSegmentIsNotStartedFromStandstill) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.ContStart({0, 800, 0, 0}));
    done(d.ContLine(0x3, {300, 0}));
    done(d.ContLine(0x3, {1'000, 10}));
    rig.port.pass(whole_seconds(1));
    const Result<ContOutcome> late = d.ContEnd(max_wait);
    ASSERT_FALSE(late);
    EXPECT_THAT(late.error().message, HasSubstr("Segment 2 of the chain came too late"));
    EXPECT_EQ(d.ReadLPS(0), 300);
    EXPECT_FALSE(d.moving(xyzu));
}

TEST(DriverPaths, SpeedsOnAnArcAreThoseOfThePulses) {
    DriverRig rig(true);
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.CircleCCW_C({0, 1'000, 0, 0, {}, {-20'000, 0}}, 0x3));
    for (int sample = 0; sample < 10; ++sample) {
        rig.port.pass(milliseconds(1'000));
        const auto reported = d.axis_speeds();
        ASSERT_TRUE(reported);
        const std::int64_t x = rig.count(0), y = rig.count(1);
        rig.port.pass(milliseconds(20));
        EXPECT_NEAR(static_cast<double>(rig.count(0) - x) / 0.02, (*reported)[0], 150) << sample;
        EXPECT_NEAR(static_cast<double>(rig.count(1) - y) / 0.02, (*reported)[1], 150) << sample;
    }
}

TEST(DriverPaths, SpeedsInAChainAreThoseOfTheActiveSegment) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.LPS(axis_x, 123'456));
    done(d.ContStart({0, 1'000, 0, 0}));
    done(d.ContLine(0x3, {10'000, -5'000}));
    done(d.ContArc(0x5, {20'000, 0, 20'000}, {0, 0, 20'000}, false));  // Z takes part from here on
    done(d.ContLine(0x3, {-10'000, 1'000}));
    for (int sample = 0; sample < 36; ++sample) {
        const auto reported = d.axis_speeds();
        ASSERT_TRUE(reported) << reported.error().message;
        const std::array<std::int64_t, 3> at = {rig.count(0), rig.count(1), rig.count(2)};
        rig.port.pass(milliseconds(20));
        const bool in_arc = rig.count(0) > 10'100;
        for (std::size_t i = 0; i < 3; ++i)
            if (in_arc || rig.count(0) < 9'900) {
                EXPECT_NEAR(static_cast<double>(rig.count(static_cast<int>(i)) - at[i]) / 0.02, (*reported)[i], 150)
                    << sample << ' ' << i;
            }
        rig.port.pass(milliseconds(60));
    }
    d.stop_all(StopKind::quick);
}

TEST(DriverPaths, ConstantVectorSpeedOfThreeAxes) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetRange(4'000'000));
    done(d.SetVectorSpeed(3));
    done(d.Line3D_C({0, 1'000, 0, 0, 0, {20'000, 20'000, -20'000}}, 0x7));
    rig.port.pass(milliseconds(500));
    const std::int64_t x = rig.count(0);
    const auto reported = d.axis_speeds();
    rig.port.pass(whole_seconds(5));
    EXPECT_NEAR(static_cast<double>(rig.count(0) - x) / 5, 2'000 / std::sqrt(3.0), 1);
    EXPECT_NEAR((*reported)[2], -2'000 / std::sqrt(3.0), 0.1);
}

TEST(DriverPaths, ConstantVectorSpeedKeepsTheSpeedAlongThePath) {
    for (const FourAxes& finish : {FourAxes{20'000, 20'000}, FourAxes{20'000, 7'000}, FourAxes{0, 20'000}}) {
        DriverRig rig;
        Driver& d = rig.driver;
        done(d.SetRange(4'000'000));
        done(d.SetVectorSpeed(2));
        done(d.Line2D_C({0, 1'000, 0, 0, 0, finish}, 0x3));
        rig.port.pass(milliseconds(500));
        const std::int64_t x = rig.count(0), y = rig.count(1);
        const auto reported = d.axis_speeds();
        rig.port.pass(whole_seconds(5));
        const double vx = static_cast<double>(rig.count(0) - x) / 5, vy = static_cast<double>(rig.count(1) - y) / 5;
        EXPECT_NEAR((*reported)[0], vx, 2);
        EXPECT_NEAR((*reported)[1], vy, 2);
        EXPECT_NEAR(std::sqrt(vx * vx + vy * vy), 2'000, 170) << "1.414 for two axes is exact at 0 and 45 degrees";
    }
}

}  // namespace
}  // namespace motionrack::mcx314
