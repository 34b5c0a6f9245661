// Tests of the function library on a virtual chip with wires: its messages, and the instants of the pulses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/test/driver_checks.hpp>
#include <motionrack/cards/mcx314/test/driver_rig.hpp>

namespace motionrack::mcx314 {
namespace {

using testing::HasSubstr;

// ---- messages

TEST(DriverMessages, StateTheCauseThePositionAndTheRemedy) {
    struct Case {
        const char* pin;
        const char* why;
        const char* next;
    };
    for (const Case& one : {Case{"xlmtp", "the + limit switch was reached", "Drive in - direction"},
                            Case{"xalarm", "the drive's alarm is active", "Clear the alarm"},
                            Case{"emgn", "the emergency stop input is active", "Release the emergency stop"},
                            Case{"xin1", "input IN1 stopped it", "check the input"}}) {
        DriverRig rig;
        Driver& d = rig.driver;
        done(d.SetMultiple(axis_x, 10));
        done(d.EnableALM(1, axis_x));
        done(d.SetStopInput(axis_x, 1, StopInput::at_low));
        done(d.TCurve_C(axis_x, 10, 100, 100));
        rig.port.pass(milliseconds(500));
        EXPECT_EQ(d.error_text(), "");
        rig.wire(one.pin, 0);
        const Result<void> stopped = d.wait_until_done(axis_x, max_wait);
        ASSERT_FALSE(stopped) << one.pin;
        EXPECT_EQ(stopped.error().kind, ErrorKind::machine);
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

TEST(DriverMessages, ReportsLimitsAndMotionSeparately) {
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

TEST(DriverFlight, RejectsASpeedChangeThatTheChipWouldIgnore) {
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
    done(d.wait_until_done(axis_x, max_wait));
    EXPECT_EQ(d.ReadLPS(0), 30'000);

    // After LPS() the library does not know the number of pulses made.
    done(d.TCurve_F(axis_z, 10, 1'000, 1'000, 4'000));
    done(d.LPS(axis_z, 77));
    const Result<void> unknown = d.change_pulses(2, 5'000);
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().message, HasSubstr("that this library started"));
    // The last pulses at SV belong to the final deceleration, too.
    done(d.SetAO(axis_z, 500));
    while (!(d.axis_status(2).constant() && d.ReadCV(2) == 10)) rig.port.pass(milliseconds(1));
    EXPECT_FALSE(d.change_speed(axis_z, 500));
    done(d.wait_until_done(axis_z, max_wait));

    done(d.TCurve_F(axis_y, 10, 1'000, 100, 4'000));
    while (!d.axis_status(1).decelerating()) rig.port.pass(milliseconds(1));
    const Result<void> late = d.change_speed(axis_y, 500);
    ASSERT_FALSE(late);
    EXPECT_THAT(late.error().message, HasSubstr("Y decelerates to its end already"));
    EXPECT_FALSE(d.change_pulses(1, 9'000));
    done(d.wait_until_done(axis_y, max_wait));
    EXPECT_EQ(d.ReadLPS(1), 4'000);
}

TEST(DriverFlight, TheNearestPossibleTargetIsReportedAndAccepted) {
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
        const std::int64_t min_pulses = std::stoll(text.substr(text.find("the minimum is ") + 15));
        EXPECT_GT(min_pulses, 5'000);
        EXPECT_LT(min_pulses, 13'700);
        done(d.change_pulses(0, -(min_pulses + 5)));
        done(d.wait_until_done(axis_x, max_wait));
        EXPECT_EQ(d.ReadLPS(0), -(min_pulses + 5));
        rig.deliver_edges();
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

TEST(DriverFlight, TheSpeedOfASlaveAxisFollowsItsMainAxis) {
    DriverRig rig;
    Driver& d = rig.driver;
    done(d.SetMultiple(xyzu, 10));
    done(d.Line2D_T({10, 500, 100, 0, 0, {0, 20'000, -5'000}}, 0x6));
    rig.port.pass(whole_seconds(1));
    const Result<void> led = d.change_speed(axis_z, 100);
    ASSERT_FALSE(led);
    EXPECT_THAT(led.error().message, HasSubstr("Z is interpolated with main axis Y"));
    EXPECT_FALSE(d.change_pulses(1, 30'000));
    done(d.change_speed(axis_y, 100));
    rig.port.pass(whole_seconds(1));
    const auto speeds = d.axis_speeds();
    EXPECT_NEAR((*speeds)[1], 1'000, 1e-6);
    EXPECT_NEAR((*speeds)[2], -250, 1e-6);
    done(d.stop(axis_z, StopKind::slow));
    done(d.wait_until_done(0x6, max_wait));
}

}  // namespace
}  // namespace motionrack::mcx314
