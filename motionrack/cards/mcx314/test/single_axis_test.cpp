// Tests of an axis of the card in millimetres on the simulated machine: valid position, moves, jog, homing, stops.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <motionrack/cards/mcx314/axes/single_axis.hpp>
#include <motionrack/cards/mcx314/test/home_rig.hpp>

namespace motionrack::mcx314 {
namespace {

using control::AxisState;
using testing::HasSubstr;

SingleAxisSettings settings() {
    SingleAxisSettings s;
    s.limits = {true, 0, 300, 50, 500, 10'000, 2, pulses_per_mm};
    s.counts_per_unit = 800;
    s.pulses_per_turn = pulses_per_turn;
    return s;
}

control::HomingRequest order(int type = 2) {
    control::HomingRequest o;
    o.method = static_cast<control::HomingMethod>(type);
    o.search_velocity = 15;
    o.latch_velocity = 0.5;
    o.home_offset = 1;
    return o;
}

struct AxisRig : HomeRig {
    explicit AxisRig(const RigAxis& axis = {}, const SingleAxisSettings& s = settings())
        : HomeRig({axis}), x(driver, s) {
        start();
        EXPECT_TRUE(SingleAxis::prepare(driver));
        EXPECT_TRUE(x.set_up());
    }
    void home(int type = 2) {
        ASSERT_TRUE(x.home(order(type), port.now()));
        const Result<void> done = x.wait(whole_seconds(60));
        ASSERT_TRUE(done) << done.error().message;
    }
    SingleAxis x;
};

TEST(SingleAxis, HasAValidPositionOnlyAfterHomingAndThenThatOfTheMachine) {
    AxisRig rig;
    EXPECT_FALSE(rig.x.position_valid());
    const Result<void> refused = rig.x.move_to(10, 20);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("not valid; home it"));
    rig.home();
    EXPECT_TRUE(rig.x.position_valid());
    EXPECT_DOUBLE_EQ(rig.x.position(), 1.0);
    EXPECT_DOUBLE_EQ(rig.x.measured_position(), 1.0);
    EXPECT_NEAR(rig.position(), 1.0, 1e-9);
    ASSERT_TRUE(rig.x.move_to(25, 40));
    EXPECT_EQ(rig.x.state(), AxisState::moving);
    ASSERT_TRUE(rig.x.wait(whole_seconds(10)));
    EXPECT_DOUBLE_EQ(rig.x.position(), 25);
    EXPECT_NEAR(rig.position(), 25, 1e-9);
    EXPECT_EQ(rig.x.state(), AxisState::standstill);
    EXPECT_EQ(rig.machines[0]->lost_steps(), 0);
}

TEST(SingleAxis, ReportsTheResultsOfHomingInMillimetres) {
    AxisRig rig;
    rig.home(4);
    const control::HomingResult out = rig.x.home_outcome();
    EXPECT_TRUE(out.homed);
    ASSERT_EQ(out.edges.size(), 4u);
    EXPECT_EQ(out.edges[3].what, "index");
    EXPECT_DOUBLE_EQ(out.edges[3].position, 1.0);
    EXPECT_DOUBLE_EQ(*out.switch_to_index, 1.0);
    EXPECT_EQ(out.stays.front().state, "CHECK_START");
    EXPECT_EQ(out.stays.back().state, "HOMED");
    double sum = 0;
    for (const control::HomingStateVisit& stay : out.stays) sum += stay.took_s;
    EXPECT_NEAR(sum, out.took_s, 1e-9);
    EXPECT_NEAR(out.moved_by, 1.0 + 20.0, 1e-9) << "the counter said -20 mm at the place that is 1 mm";
}

TEST(SingleAxis, SoftwareLimitsAreInForceExactlyWhileThePositionIsValid) {
    AxisRig rig;
    EXPECT_EQ(rig.driver.mode2(0) & 3, 0);
    rig.home();
    EXPECT_EQ(rig.driver.mode2(0) & 3, 3);
    ASSERT_TRUE(rig.x.home(order(), rig.port.now()));
    EXPECT_EQ(rig.driver.mode2(0) & 3, 0);
    rig.x.stop();
    EXPECT_FALSE(rig.x.wait(whole_seconds(5)));
    EXPECT_FALSE(rig.x.position_valid());
    EXPECT_EQ(rig.driver.mode2(0) & 3, 0);
    ASSERT_TRUE(rig.x.set_position(7.5));
    EXPECT_TRUE(rig.x.position_valid());
    EXPECT_DOUBLE_EQ(rig.x.position(), 7.5);
    EXPECT_DOUBLE_EQ(rig.x.measured_position(), 7.5);
}

TEST(SingleAxis, RejectsMovesWithValueAndLimitAndMovesNothing) {
    AxisRig rig;
    rig.home();
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    const auto message = [](const Result<void>& result) {
        EXPECT_FALSE(result);
        return result ? std::string() : result.error().message;
    };
    EXPECT_THAT(message(rig.x.move_to(301, 10)), HasSubstr("301 mm is outside its travel of 0 to 300"));
    EXPECT_THAT(message(rig.x.move_to(10, 51)), HasSubstr("the velocity is 51 mm/s; it must be above 0 and up to 50"));
    for (const double bad : {nan, inf, -inf, 0.0, -1.0}) {
        EXPECT_FALSE(rig.x.move_to(10, bad));
        control::HomingRequest o = order();
        o.search_velocity = bad;
        EXPECT_FALSE(rig.x.home(o, rig.port.now()));
        o = order();
        o.latch_velocity = bad;
        EXPECT_FALSE(rig.x.home(o, rig.port.now()));
    }
    for (const double bad : {nan, inf, -inf}) {
        EXPECT_FALSE(rig.x.move_to(bad, 10));
        EXPECT_FALSE(rig.x.move_by(bad, 10));
        EXPECT_FALSE(rig.x.set_position(bad));
        EXPECT_FALSE(rig.x.jog(bad, rig.port.now()));
        control::HomingRequest o = order();
        o.home_offset = bad;
        EXPECT_FALSE(rig.x.home(o, rig.port.now()));
        o = order();
        o.backoff = bad;
        EXPECT_FALSE(rig.x.home(o, rig.port.now()));
        o = order();
        o.travel = bad;
        EXPECT_FALSE(rig.x.home(o, rig.port.now()));
    }
    EXPECT_TRUE(rig.x.position_valid());
    EXPECT_DOUBLE_EQ(rig.x.position(), 1.0);
    SingleAxisSettings blind = settings();
    blind.counts_per_unit = 0;
    AxisRig no_encoder({}, blind);
    EXPECT_THAT(message(no_encoder.x.home(order(4), no_encoder.port.now())), HasSubstr("no encoder, so no index"));
    ASSERT_TRUE(rig.x.move_to(100, 10));
    EXPECT_THAT(message(rig.x.move_to(50, 10)), HasSubstr("it moves; stop it"));
    EXPECT_THAT(message(rig.x.jog(10, rig.port.now())), HasSubstr("it moves"));
    EXPECT_THAT(message(rig.x.home(order(), rig.port.now())), HasSubstr("it moves"));
    EXPECT_THAT(message(rig.x.set_position(0)), HasSubstr("it moves"));
}

TEST(SingleAxis, ADeceleratingStopKeepsThePositionValidAndAnImmediateOneAtSpeedDoesNot) {
    AxisRig rig;
    rig.home();
    ASSERT_TRUE(rig.x.move_to(200, 50));
    rig.port.pass(milliseconds(500));
    rig.x.stop();
    EXPECT_EQ(rig.x.state(), AxisState::stopping);
    ASSERT_TRUE(rig.x.wait(whole_seconds(5)));
    EXPECT_TRUE(rig.x.position_valid());
    EXPECT_NEAR(rig.position(), rig.x.position(), 1e-9);
    ASSERT_TRUE(rig.x.move_to(200, 50));
    rig.port.pass(milliseconds(500));
    rig.x.stop_now();
    ASSERT_TRUE(rig.x.wait(whole_seconds(5)));
    EXPECT_FALSE(rig.x.position_valid());
    rig.port.pass(milliseconds(5));
    EXPECT_NE(rig.machines[0]->lost_steps(), 0) << "and rightly so";
}

TEST(SingleAxis, AnEmergencyStopInvalidatesThePosition) {
    AxisRig rig;
    rig.home();
    ASSERT_TRUE(rig.x.move_to(200, 50));
    rig.port.pass(milliseconds(500));
    rig.hold_wire("c.emgn", 0);
    const Result<void> ended = rig.x.wait(whole_seconds(5));
    ASSERT_FALSE(ended);
    EXPECT_THAT(ended.error().message, HasSubstr("Its position is not valid; home it."));
    EXPECT_EQ(rig.x.state(), AxisState::error);
    EXPECT_FALSE(rig.x.position_valid());
}

TEST(SingleAxis, JogsInMillimetresAndOnlyWhileItIsRenewed) {
    AxisRig rig;
    for (int i = 0; i < 500; ++i) {
        ASSERT_TRUE(rig.x.jog(i < 250 ? 10 : 20, rig.port.now()));
        rig.x.step(rig.port.now());
        rig.port.pass(milliseconds(1));
    }
    EXPECT_EQ(rig.x.state(), AxisState::jogging);
    EXPECT_NEAR(rig.machines[0]->velocity(), 20, 0.01);
    ASSERT_TRUE(rig.x.wait(whole_seconds(5)));
    EXPECT_EQ(rig.x.state(), AxisState::standstill);
    EXPECT_EQ(rig.machines[0]->lost_steps(), 0);
    ASSERT_TRUE(rig.x.move_by(-1.5, 10)) << "a step, without a valid position";
    const double before = rig.position();
    ASSERT_TRUE(rig.x.wait(whole_seconds(5)));
    EXPECT_NEAR(rig.position(), before - 1.5, 1e-9);
}

TEST(SingleAxis, AMoveIntoALimitIsReported) {
    AxisRig rig({.limit_plus_mm = 40});
    rig.home();
    ASSERT_TRUE(rig.x.move_to(80, 20));
    const Result<void> ended = rig.x.wait(whole_seconds(20));
    ASSERT_FALSE(ended);
    EXPECT_THAT(ended.error().message, HasSubstr("+ limit switch"));
    EXPECT_TRUE(rig.x.position_valid()) << "it decelerated";
    EXPECT_FALSE(rig.x.move_to(60, 20));
    EXPECT_TRUE(rig.x.move_to(20, 20));
}

TEST(SingleAxis, AWaitTimesOutAndReportsThePosition) {
    AxisRig rig;
    rig.home();
    ASSERT_TRUE(rig.x.move_to(300, 5));
    const Result<void> ended = rig.x.wait(whole_seconds(1));
    ASSERT_FALSE(ended);
    EXPECT_THAT(ended.error().message, HasSubstr("still moves after 1.000 s, at"));
    EXPECT_TRUE(rig.driver.moving(1));
}

RC_GTEST_PROP(SingleAxisProperty, AfterHomingTheCounterIsTheMachine, ()) {
    AxisRig rig({.start_mm = *rc::gen::inRange(0, 200) / 10.0, .bounce = milliseconds(1)});
    control::HomingRequest o = order();
    o.search_velocity = *rc::gen::inRange(1, 51);
    o.latch_velocity = *rc::gen::inRange(1, 11) / 10.0;
    RC_ASSERT(bool(rig.x.home(o, rig.port.now())));
    RC_ASSERT(bool(rig.x.wait(whole_seconds(100))));
    for (int i = 0; i < 3; ++i) {
        RC_ASSERT(bool(rig.x.move_to(*rc::gen::inRange(0, 6400) / pulses_per_mm, *rc::gen::inRange(1, 51))));
        RC_ASSERT(bool(rig.x.wait(whole_seconds(100))));
    }
    // The edge of the switch is at the first pulse at or below its position, so it is exact to one pulse.
    RC_ASSERT(std::abs(rig.position() - rig.x.position()) < 1.01 / pulses_per_mm);
}

}  // namespace
}  // namespace motionrack::mcx314
