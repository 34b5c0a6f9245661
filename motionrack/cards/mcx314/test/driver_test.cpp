// The function library on a virtual chip with wires: what it says, and when the pulses come.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/cards/mcx314/test/driver_rig.hpp>

namespace motionrack::mcx314 {
namespace {

using testing::HasSubstr;

constexpr Duration patience = whole_seconds(60);

void done(const Result<void>& result) {
    ASSERT_TRUE(result) << result.error().message;
}

/// Pulses a second between the last pulses of an axis.
double last_rate(const outside::EdgeLog& log, std::size_t pulses) {
    const auto& list = log.list;
    const std::int64_t ticks = list.back().tick - list[list.size() - 1 - pulses].tick;
    return static_cast<double>(pulses) * 8e6 / static_cast<double>(ticks);
}

// ---- messages
// ---------------------------------------------------------------------------------------------------------

TEST(DriverMessages, TellTheCauseThePlaceAndWhatToDo) {
    struct Case {
        const char* pin;
        const char* why;
        const char* next;
    };
    for (const Case& one : {Case{"xlmtp", "the + limit switch was reached", "Drive in - direction"},
                            Case{"xalarm", "the drive's alarm is active", "Clear the alarm"},
                            Case{"emgn", "the emergency stop input is active", "Release the emergency stop"},
                            Case{"xin1", "input IN1 stopped it", "look at the input"}}) {
        DriverRig rig;
        Driver& d = rig.driver;
        done(d.SetMultiple(axis_x, 10));
        done(d.EnableALM(1, axis_x));
        done(d.SetStopInput(axis_x, 1, StopInput::at_low));
        done(d.TCurve_C(axis_x, 10, 100, 100));
        rig.port.pass(milliseconds(500));
        EXPECT_EQ(d.error_text(), "");
        rig.wire(one.pin, 0);
        const Result<void> stopped = d.wait_until_done(axis_x, patience);
        ASSERT_FALSE(stopped) << one.pin;
        EXPECT_EQ(stopped.error().trouble, Trouble::machine);
        EXPECT_THAT(stopped.error().message, HasSubstr(one.why));
        EXPECT_THAT(stopped.error().message, HasSubstr(one.next));
        EXPECT_THAT(stopped.error().message, HasSubstr("X stands at LP " + std::to_string(d.ReadLPS(0))));
    }
}

TEST(DriverMessages, EveryStatusBitHasANameAndAMeaning) {
    for (const StatusBit& bit : status_bits()) {
        EXPECT_FALSE(bit.name.empty());
        EXPECT_FALSE(bit.meaning.empty()) << bit.name;
        EXPECT_THAT(explain(bit.reg, bit.mask), HasSubstr(std::string(bit.name) + ": " + std::string(bit.meaning)));
    }
    EXPECT_EQ(explain("RR1", 0), "");
    EXPECT_EQ(explain("RR0", 0x1400), "ZONE: octant of a circular interpolation, 0..7 = 5.\n");
    EXPECT_THAT(explain("RR2", 0x0004), HasSubstr("Drive in - direction, away from the switch"));
}

TEST(DriverMessages, LimitsAndMotionAreToldApart) {
    DriverRig rig;
    done(rig.driver.SetMultiple(axis_y, 10));
    rig.wire("ylmtm", 0);
    EXPECT_TRUE(rig.driver.axis_status(1).at_minus_limit());
    EXPECT_FALSE(rig.driver.axis_status(1).at_plus_limit());
    EXPECT_FALSE(rig.driver.moving(axis_y));
    done(rig.driver.TCurve_F(axis_y, 10, 500, 10, 1'000));
    rig.port.pass(milliseconds(20));
    EXPECT_TRUE(rig.driver.axis_status(1).accelerating());
    const AxisReport report = rig.driver.report(1);
    EXPECT_TRUE(report.driving);
    EXPECT_GT(report.cv, 10);
    EXPECT_THAT(report.text(), HasSubstr("Y drives at LP " + std::to_string(report.lp)));
}

// ---- changes while driving
// --------------------------------------------------------------------------------------------

TEST(DriverFlight, ASpeedIsNotChangedWhereTheChipWouldNotTakeIt) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.SCurve_F(axis_x, 10, 1'000, 2'000, 500, 20'000));
    rig.port.pass(milliseconds(50));
    const Result<void> in_ramp = d.change_speed(axis_x, 500);
    ASSERT_FALSE(in_ramp);
    EXPECT_THAT(in_ramp.error().message, HasSubstr("X is in a ramp of an S-curve"));
    EXPECT_FALSE(d.change_pulses(0, 30'000));
    while (!d.axis_status(0).constant()) rig.port.pass(milliseconds(1));
    done(d.change_pulses(0, 30'000));
    done(d.change_speed(axis_x, 900));
    done(d.wait_until_done(axis_x, patience));
    EXPECT_EQ(d.ReadLPS(0), 30'000);

    // Where the counter was set meanwhile, the pulses made are not known.
    done(d.TCurve_F(axis_z, 10, 1'000, 1'000, 4'000));
    done(d.LPS(axis_z, 77));
    const Result<void> unknown = d.change_pulses(2, 5'000);
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().message, HasSubstr("of which this library knows the start"));
    // The last pulses at SV belong to the end too.
    done(d.SetAO(axis_z, 500));
    while (!(d.axis_status(2).constant() && d.ReadCV(2) == 10)) rig.port.pass(milliseconds(1));
    EXPECT_FALSE(d.change_speed(axis_z, 500));
    done(d.wait_until_done(axis_z, patience));

    done(d.TCurve_F(axis_y, 10, 1'000, 100, 4'000));
    while (!d.axis_status(1).decelerating()) rig.port.pass(milliseconds(1));
    const Result<void> late = d.change_speed(axis_y, 500);
    ASSERT_FALSE(late);
    EXPECT_THAT(late.error().message, HasSubstr("Y decelerates to its end already"));
    EXPECT_FALSE(d.change_pulses(1, 9'000));
    done(d.wait_until_done(axis_y, patience));
    EXPECT_EQ(d.ReadLPS(1), 4'000);
}

TEST(DriverFlight, TheLeastPossibleTargetIsToldAndTaken) {
    for (const bool manual : {false, true}) {
        DriverRig rig(true);
        Driver& d = rig.driver;
        done(d.SetMultiple(axis_x, 10));
        done(d.SetAO(axis_x, 5));
        if (manual) done(d.ManualDec(axis_x, 36'000));
        done(d.TCurve_F(axis_x, 10, 2'000, 400, -40'000));
        rig.port.pass(milliseconds(500));
        const Result<void> refused = d.change_pulses(0, -5'000);
        ASSERT_FALSE(refused);
        const std::string& text = refused.error().message;
        const std::int64_t least = std::stoll(text.substr(text.find("least possible is ") + 18));
        EXPECT_GT(least, 5'000);
        EXPECT_LT(least, 13'700);
        done(d.change_pulses(0, -(least + 5)));
        done(d.wait_until_done(axis_x, patience));
        EXPECT_EQ(d.ReadLPS(0), -(least + 5));
        rig.hand_over_edges();
        EXPECT_LT(last_rate(rig.edges[0], 1), 250) << "it ends at SV, 100 pulses/s";
    }
}

TEST(DriverFlight, AWaitMayBeAsLongAsTheDrive) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    for (const Duration timeout : {never, never - milliseconds(1)}) {
        done(d.TCurve_F(axis_x, 10, 1'000, 100, 2'000));
        done(d.wait_until_done(axis_x, timeout));
    }
    EXPECT_EQ(d.ReadLPS(0), 4'000);
    done(d.ContStart({20, 800, 400, 0}));
    done(d.ContLine(0x3, {1'000, 0}, 0, never));
    done(d.ContLine(0x3, {1'000, 500}, 0, never));
    EXPECT_TRUE(d.ContEnd(never));
    EXPECT_EQ(d.ReadLPS(0), 6'000);
}

TEST(DriverFlight, TheSpeedOfALedAxisIsThatOfItsLeader) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.Line2D_T({10, 500, 100, 0, 0, {0, 20'000, -5'000}}, 0x6));
    rig.port.pass(whole_seconds(1));
    const Result<void> led = d.change_speed(axis_z, 100);
    ASSERT_FALSE(led);
    EXPECT_THAT(led.error().message, HasSubstr("Z is led by Y"));
    EXPECT_FALSE(d.change_pulses(1, 30'000));
    done(d.change_speed(axis_y, 100));
    rig.port.pass(whole_seconds(1));
    const auto speeds = d.axis_speeds();
    EXPECT_NEAR((*speeds)[1], 1'000, 1e-6);
    EXPECT_NEAR((*speeds)[2], -250, 1e-6);
    done(d.stop(axis_z, StopKind::slow));
    done(d.wait_until_done(0x6, patience));
}

// ---- interpolation
// ----------------------------------------------------------------------------------------------------

TEST(DriverPaths, ArcsWithATrapezoidEndAtTheirInitialSpeed) {
    for (const std::int64_t decel : {0, 300})
        for (const bool clockwise : {false, true}) {
            DriverRig rig(true);
            Driver& d = rig.driver;
            done(d.SetMultiple(xyzu, 10));
            const CIRCLEDATA data{20, 1'000, 800, decel, {3'000, clockwise ? -3'000 : 3'000}, {3'000, 0}};
            done(clockwise ? d.CircleCCW_T(data, 0x3) : d.CircleCW_T(data, 0x3));
            done(d.wait_until_done(0x3, patience));
            EXPECT_EQ(d.ReadLPS(0), 3'000);
            rig.hand_over_edges();
            // The regular axis at the end is X: it steps at each basic pulse.
            EXPECT_NEAR(last_rate(rig.edges[0], 1), 200, 60);
            EXPECT_GT(last_rate(rig.edges[0], 100), 400) << "and does not creep";
        }
}

TEST(DriverPaths, AnAsymmetricLineEndsAtItsInitialSpeed) {
    DriverRig rig(true);
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.Line2D_T({20, 1'000, 800, 200, 0, {9'000, -4'000}}, 0x3));
    done(d.wait_until_done(0x3, patience));
    rig.hand_over_edges();
    EXPECT_NEAR(last_rate(rig.edges[0], 1), 200, 40);
    EXPECT_GT(last_rate(rig.edges[0], 100), 400);
}

TEST(DriverPaths, AChainKeepsItsSpeedOverTheJointsAndDeceleratesInItsLastSegment) {
    DriverRig rig(true);
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.ContStart({20, 800, 400, 0}));
    for (int i = 0; i < 5; ++i) done(d.ContLine(0x3, {1'000, i % 2 == 0 ? 300 : -300}, i == 2 ? 400 : 0));
    done(d.ContArc(0x3, {2'000, 2'000}, {0, 2'000}, false));
    const Result<ContOutcome> outcome = d.ContEnd(patience);
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_EQ(outcome->segments, 6);
    EXPECT_EQ(outcome->end_speed, 20);
    EXPECT_EQ(d.ReadLPS(0), 7'000);
    EXPECT_EQ(d.ReadLPS(1), 2'300);
    rig.hand_over_edges();
    const auto& x = rig.edges[0].list;
    for (std::size_t i = 1'200; i < 1'900; ++i) EXPECT_LE(x[i].tick - x[i - 1].tick, 1'001) << i;  // 8,000 pulses/s
    for (std::size_t i = 2'800; i < 5'000; ++i)
        EXPECT_LE(x[i].tick - x[i - 1].tick, 2'001) << i;  // 4,000 from segment 3 on
    for (std::size_t i = 2'800; i < 5'000; ++i) EXPECT_GE(x[i].tick - x[i - 1].tick, 1'999) << i;
    EXPECT_NEAR(last_rate(rig.edges[1], 1), 200, 60);
}

TEST(DriverPaths, AChainsLastSegmentThatIsTooShortLowersTheSpeedBefore) {
    DriverRig rig(true);
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.ContStart({20, 800, 400, 0}));
    done(d.ContLine(0x3, {3'000, 0}));
    done(d.ContLine(0x3, {50, 10}));
    const Result<ContOutcome> outcome = d.ContEnd(patience);
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_EQ(outcome->end_speed, 20);
    rig.hand_over_edges();
    EXPECT_NEAR(last_rate(rig.edges[0], 1), 200, 60);
    // Where no segment has room for the fall, that is told.
    done(d.ContStart({20, 800, 800, 0}));
    done(d.ContLine(0x3, {3'000, 0}));
    done(d.ContLine(0x3, {3, 1}));
    done(d.ContLine(0x3, {3, 1}));
    done(d.ContLine(0x3, {3, 1}));
    const Result<ContOutcome> fast = d.ContEnd(patience);
    ASSERT_TRUE(fast) << fast.error().message;
    EXPECT_GT(fast->end_speed, 20);
}

TEST(DriverPaths, AChainThatALimitStopsSaysSo) {
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
    EXPECT_EQ(stopped.error().trouble, Trouble::machine);
    EXPECT_THAT(stopped.error().message, HasSubstr("The chain was stopped. X stands at LP"));
    EXPECT_THAT(stopped.error().message, HasSubstr("the + limit switch was reached"));
    EXPECT_FALSE(d.ContEnd(patience));
}

TEST(DriverPaths, ALateSegmentIsNotStartedFromStandstill) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.ContStart({0, 800, 0, 0}));
    done(d.ContLine(0x3, {300, 0}));
    done(d.ContLine(0x3, {1'000, 10}));
    rig.port.pass(whole_seconds(1));
    const Result<ContOutcome> late = d.ContEnd(patience);
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
        const auto told = d.axis_speeds();
        ASSERT_TRUE(told);
        const std::int64_t x = rig.count(0), y = rig.count(1);
        rig.port.pass(milliseconds(20));
        EXPECT_NEAR(static_cast<double>(rig.count(0) - x) / 0.02, (*told)[0], 150) << sample;
        EXPECT_NEAR(static_cast<double>(rig.count(1) - y) / 0.02, (*told)[1], 150) << sample;
    }
}

TEST(DriverPaths, SpeedsInAChainAreThoseOfTheSegmentThatRuns) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.LPS(axis_x, 123'456));
    done(d.ContStart({0, 1'000, 0, 0}));
    done(d.ContLine(0x3, {10'000, -5'000}));
    done(d.ContArc(0x5, {20'000, 0, 20'000}, {0, 0, 20'000}, false));  // Z joins
    done(d.ContLine(0x3, {-10'000, 1'000}));
    for (int sample = 0; sample < 36; ++sample) {
        const auto told = d.axis_speeds();
        ASSERT_TRUE(told) << told.error().message;
        const std::array<std::int64_t, 3> at = {rig.count(0), rig.count(1), rig.count(2)};
        rig.port.pass(milliseconds(20));
        const bool in_arc = rig.count(0) > 10'100;
        for (std::size_t i = 0; i < 3; ++i)
            if (in_arc || rig.count(0) < 9'900) {
                EXPECT_NEAR(static_cast<double>(rig.count(static_cast<int>(i)) - at[i]) / 0.02, (*told)[i], 150)
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
    const auto told = d.axis_speeds();
    rig.port.pass(whole_seconds(5));
    EXPECT_NEAR(static_cast<double>(rig.count(0) - x) / 5, 2'000 / std::sqrt(3.0), 1);
    EXPECT_NEAR((*told)[2], -2'000 / std::sqrt(3.0), 0.1);
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
        const auto told = d.axis_speeds();
        rig.port.pass(whole_seconds(5));
        const double vx = static_cast<double>(rig.count(0) - x) / 5, vy = static_cast<double>(rig.count(1) - y) / 5;
        EXPECT_NEAR((*told)[0], vx, 2);
        EXPECT_NEAR((*told)[1], vy, 2);
        EXPECT_NEAR(std::sqrt(vx * vx + vy * vy), 2'000, 170) << "1.414 for two axes is exact at 0 and 45 degrees";
    }
}

}  // namespace
}  // namespace motionrack::mcx314
