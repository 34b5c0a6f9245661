// Tests of interrupted homings, several axes at once and random positions: the position is valid only after success,
// and the axis stands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <motionrack/cards/mcx314/test/home_rig.hpp>
#include <set>

namespace motionrack::mcx314 {
namespace {

using testing::HasSubstr;

/// Polls every millisecond until `until` returns true or the homing has ended.
template <class Until>
void step_until(HomeRig& rig, Home& one, Until until) {
    while (one.running() && !until()) {
        one.step(rig.port.now());
        rig.port.pass(milliseconds(1));
    }
}
void run_out(HomeRig& rig, Home& one) {
    step_until(rig, one, [] { return false; });
}

TEST(HomingStops, StopIsAcceptedInEveryStateAndThePositionIsNotValid) {
    for (int type = 1; type <= 5; ++type) {
        for (const HomeState& state : home_table(type).states) {
            const bool waits = state.does == HomingAction::wait_end || state.does == HomingAction::wait_steady;
            if (!waits || state.name == "RETURN_WAIT") continue;
            HomeRig rig({RigAxis{.start_mm = 0.5 + type}});
            rig.start();
            Home one(rig.driver, 0);
            ASSERT_TRUE(one.start(rig_settings(type), rig.port.now()));
            step_until(rig, one, [&] { return one.state() == state.name; });
            if (!one.running()) continue;  // the homing from this start does not pass the state
            one.stop();
            run_out(rig, one);
            EXPECT_FALSE(rig.driver.moving(1)) << state.name;
            EXPECT_FALSE(one.homed()) << state.name;
            EXPECT_EQ(one.report().fault, HomeFault::stopped) << state.name;
            EXPECT_THAT(one.report().sentence, HasSubstr("stopped on request"));
            EXPECT_EQ(one.state(), "FAILED");
            EXPECT_EQ(one.report().result().error().kind, ErrorKind::stopped);
        }
    }
}

TEST(HomingStops, AStopAfterTheEndHasNoEffect) {
    HomeRig rig;
    rig.start();
    Home one(rig.driver, 0);
    ASSERT_TRUE(one.start(rig_settings(2), rig.port.now()));
    run_out(rig, one);
    ASSERT_TRUE(one.homed());
    one.stop();
    one.step(rig.port.now());
    EXPECT_TRUE(one.homed());
}

TEST(HomingStops, ANewStartInvalidatesThePositionAndARefusedOneDoesNot) {
    HomeRig rig;
    rig.start();
    Home one(rig.driver, 0);
    ASSERT_TRUE(one.start(rig_settings(2), rig.port.now()));
    run_out(rig, one);
    ASSERT_TRUE(one.homed());
    HomeSettings wrong = rig_settings(2);
    wrong.type = 0;
    EXPECT_FALSE(one.start(wrong, rig.port.now()));
    EXPECT_TRUE(one.homed());
    ASSERT_TRUE(one.start(rig_settings(2), rig.port.now()));
    EXPECT_FALSE(one.homed());
}

TEST(HomingStops, EmergencyStopAndAlarmAreReported) {
    for (const bool emergency : {true, false}) {
        HomeRig rig;
        rig.start();
        ASSERT_TRUE(rig.driver.EnableALM(1, 1));
        Home one(rig.driver, 0);
        ASSERT_TRUE(one.start(rig_settings(2), rig.port.now()));
        step_until(rig, one, [&] { return rig.port.now() > milliseconds(300); });
        rig.hold_wire(emergency ? "c.emgn" : "c.xalarm", 0);
        run_out(rig, one);
        EXPECT_EQ(one.report().fault, emergency ? HomeFault::emergency : HomeFault::alarm);
        EXPECT_THAT(one.report().sentence,
                    HasSubstr(emergency ? "emergency stop became active" : "alarm became active"));
        EXPECT_FALSE(rig.driver.moving(1));
    }
}

TEST(HomingStops, AnAxisThatNeverComesIntoPositionTimesOut) {
    HomeRig rig;
    rig.start();
    ASSERT_TRUE(rig.driver.EnableInPos(1, 1));
    HomeSettings s = rig_settings(2);
    s.timeout = whole_seconds(5);
    const Result<HomeReport> done = home(rig.driver, 0, s);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("SEARCH_WAIT lasted 5.00"));
    EXPECT_THAT(done.error().message, HasSubstr("nINPOS"));
}

TEST(HomingStops, AStopOfAnotherCallerIsNotTakenForTheSwitch) {
    HomeRig rig;
    rig.start();
    Home one(rig.driver, 0);
    ASSERT_TRUE(one.start(rig_settings(2), rig.port.now()));
    step_until(rig, one, [&] { return rig.port.now() > milliseconds(300); });
    rig.driver.QuickStop(1);
    run_out(rig, one);
    EXPECT_EQ(one.report().fault, HomeFault::foreign_stop);
    EXPECT_THAT(one.report().sentence, HasSubstr("the drive of SEARCH_WAIT ended after"));
}

TEST(HomingStops, AWaitEndsAtItsTimeout) {
    HomeRig rig({RigAxis{.start_mm = 300}});
    rig.start();
    const Result<HomeReport> done = home(rig.driver, 0, rig_settings(2), whole_seconds(2));
    ASSERT_FALSE(done);
    EXPECT_FALSE(rig.driver.moving(1));
    EXPECT_LT(rig.port.now(), whole_seconds(3));
}

// ---- several axes

TEST(HomingTogether, TwoAxesHomeAtOnceAndTakeNoLongerThanTheSlowerOne) {
    HomeRig rig({RigAxis{.start_mm = 20}, RigAxis{.start_mm = 60, .bounce = milliseconds(1)}});
    rig.start();
    Home x(rig.driver, 0), y(rig.driver, 1);
    ASSERT_TRUE(x.start(rig_settings(2), rig.port.now()));
    ASSERT_TRUE(y.start(rig_settings(4), rig.port.now()));
    Home* const both[] = {&x, &y};
    const Result<void> done = finish_homes(both, whole_seconds(60));
    ASSERT_TRUE(done) << done.error().message;
    EXPECT_DOUBLE_EQ(rig.position(0), 1.0);
    EXPECT_EQ(rig.rotor(1) % pulses_per_turn, 0);
    EXPECT_LT(x.report().took, y.report().took);
    EXPECT_LT(rig.port.now(), y.report().took + milliseconds(3));
}

TEST(HomingTogether, AFailureOfOneAxisStopsTheOther) {
    HomeRig rig({RigAxis{.start_mm = 200}, RigAxis{.wired_home = false}});
    rig.start();
    Home x(rig.driver, 0), y(rig.driver, 1);
    HomeSettings s = rig_settings(2);
    s.turn_at_limit = false;
    ASSERT_TRUE(x.start(s, rig.port.now()));
    ASSERT_TRUE(y.start(s, rig.port.now()));
    Home* const both[] = {&x, &y};
    const Result<void> done = finish_homes(both, whole_seconds(60));
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("Axis Y is not homed: the home switch"));
    EXPECT_EQ(x.report().fault, HomeFault::stopped);
    EXPECT_FALSE(rig.driver.moving(xyzu));
}

TEST(HomingTogether, TheSourcesFunctionsHomeEveryAxisOfTheMask) {
    using Function =
        Result<std::vector<HomeReport>> (*)(Driver&, unsigned, unsigned, std::int64_t, std::int64_t, std::int64_t);
    for (const Function function : {&HomeType1, &HomeType2, &HomeType3, &HomeType4}) {
        HomeRig rig({RigAxis{.start_mm = 12}, RigAxis{.start_mm = 23}});
        rig.start();
        const auto done =
            function(rig.driver, axis_x | axis_y, 0x0012, 50, 1000, 100);  // IN0 active Low, IN2 active High
        ASSERT_TRUE(done) << done.error().message;
        ASSERT_EQ(done->size(), 2u);
        EXPECT_TRUE((*done)[0].homed && (*done)[1].homed);
        EXPECT_EQ(rig.driver.ReadLPS(0), 0);
        EXPECT_EQ(rig.driver.ReadLPS(1), 0);
    }
    HomeRig rig;
    rig.start();
    EXPECT_FALSE(HomeType1(rig.driver, 0, 2, 50, 1000, 100));
    EXPECT_FALSE(HomeType1(rig.driver, 1, 2, 50, 9000, 100));
    EXPECT_EQ(rig.rotor(), 0);
}

// ---- any position, any speed

RC_GTEST_PROP(HomingProperty, FromAnywhereEveryTypeEndsWhereItDoesFromElsewhere, ()) {
    const int type = *rc::gen::inRange(1, 6);
    RigAxis axis;
    axis.home_mm = 1 + *rc::gen::inRange(1, 7) * 0.5;  // never at the index, which is at whole revolutions of 5 mm
    axis.hysteresis_mm = *rc::gen::element(0.0, 0.05, 0.4);
    axis.bounce = *rc::gen::element(Duration{0}, microseconds(300), milliseconds(2));
    HomeSettings s = rig_settings(type);
    s.v = *rc::gen::inRange(60, 2500);
    s.a = *rc::gen::inRange(50, 400);
    std::set<std::int64_t> ends;
    for (int i = 0; i < 2; ++i) {
        // Starts on the same grid of revolutions, so the index is at the same positions of the table.
        axis.start_mm = 5 * *rc::gen::inRange(-1, 12);
        HomeRig rig({axis});
        rig.start();
        // Moves off the grid, so that the start position within a revolution is random, too.
        const std::int64_t off = *rc::gen::inRange(0, 1500);
        RC_ASSERT(bool(rig.driver.TCurve_F(1, 50, 500, 100, off)));
        RC_ASSERT(bool(rig.driver.wait_until_stopped(1, whole_seconds(10))));
        const Result<HomeReport> report = home(rig.driver, 0, s);
        if (!report) RC_FAIL(report.error().message);
        RC_ASSERT(rig.driver.ReadLPS(0) == 0);
        RC_ASSERT(rig.driver.ReadEPS(0) == 0);
        RC_ASSERT(rig.machines[0]->lost_steps() == 0);
        // The report contains the true position of the edge, despite bounce and rare polls.
        const std::int64_t edge = static_cast<std::int64_t>(axis.home_mm * pulses_per_mm) -
                                  static_cast<std::int64_t>(axis.start_mm * pulses_per_mm);
        for (const ChipHomingEdge& seen : report->edges) {
            if (seen.input != 0 || !seen.active) continue;
            RC_ASSERT(seen.lp <= edge);
            RC_ASSERT(edge <= seen.lp + seen.within);
        }
        ends.insert(rig.rotor() + static_cast<std::int64_t>(axis.start_mm * pulses_per_mm));
        if (type == 2 || type == 5) RC_ASSERT(*ends.begin() == static_cast<std::int64_t>(axis.home_mm * pulses_per_mm));
        if (type == 3 || type == 4) RC_ASSERT(rig.rotor() % pulses_per_turn == 0);
    }
    RC_ASSERT(ends.size() == 1u);
}

RC_GTEST_PROP(HomingProperty, StoppedAtAnyMomentItStandsAndHomesAgain, ()) {
    const int type = *rc::gen::inRange(1, 6);
    RigAxis axis;
    axis.start_mm = *rc::gen::inRange(-4, 30) + 0.5;
    axis.bounce = milliseconds(1);
    HomeRig rig({axis});
    rig.start();
    Home one(rig.driver, 0);
    RC_ASSERT(bool(one.start(rig_settings(type), rig.port.now())));
    const Instant when = milliseconds(*rc::gen::inRange(0, 3000));
    step_until(rig, one, [&] { return rig.port.now() >= when; });
    one.stop();
    run_out(rig, one);
    RC_ASSERT(!rig.driver.moving(1));
    const Result<HomeReport> again = home(rig.driver, 0, rig_settings(type));
    if (!again) RC_FAIL(again.error().message);
    RC_ASSERT(again->homed);
}

}  // namespace
}  // namespace motionrack::mcx314
