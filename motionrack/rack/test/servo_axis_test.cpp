// A servo axis on a positioning card, in mm: moves, jogs, stops, homing, and faults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/homing.hpp>
#include <motionrack/rack/quantities.hpp>
#include <motionrack/rack/test/config_helpers.hpp>
#include <motionrack/rack/test/servo_helpers.hpp>
#include <motionrack/rack/wire_access.hpp>

namespace motionrack::rack {
namespace {

using control::AxisState;
using ::testing::HasSubstr;

struct Machine {
    explicit Machine(const std::string& text = carriage()) : rack(good(text)), context(rack) {
        rack.start();
        axis = *rack.axes()[0].card->axis(rack.config(), 'X');
    }
    double mm() { return rack.axes()[0].machine->position(rack.kernel().now()); }
    double velocity() { return rack.axes()[0].velocity(rack.kernel().now()); }
    sim::VirtualHost& host() { return rack.axes()[0].card->host(); }
    Instant now() { return rack.kernel().now(); }
    /// Lets this time pass; steps the axis every millisecond.
    void run(Duration time) {
        for (const Instant end = now() + time; now() < end; host().pass(milliseconds(1))) axis->step(now());
    }
    void here_is(double mm) { ASSERT_TRUE(axis->set_position(mm)); }

    Rack rack;
    WireAccess context;
    control::Axis* axis = nullptr;
};

TEST(ServoAxis, MovesToPositionsInMmAndReportsItsPosition) {
    Machine m;
    m.here_is(100);
    for (const double place : {2'560.0, 1'280.0, -150.0, 0.0}) {
        ASSERT_TRUE(m.axis->move_to(place, 500));
        EXPECT_EQ(m.axis->state(), AxisState::moving);
        ASSERT_TRUE(m.axis->wait(whole_seconds(30)));
        EXPECT_EQ(m.axis->state(), AxisState::standstill);
        EXPECT_NEAR(m.mm(), place, 0.3);
        EXPECT_NEAR(m.axis->position(), m.mm(), 1e-9) << "the counter has every count of the encoder";
        EXPECT_EQ(m.axis->measured_position(), m.axis->position());
    }
    EXPECT_TRUE(m.axis->position_valid());
}

TEST(ServoAxis, MovesAtTheRequestedVelocityAndByADistanceWithoutAValidPosition) {
    Machine m;
    EXPECT_FALSE(m.axis->position_valid());
    ASSERT_TRUE(m.axis->move_by(50, 20));
    m.run(whole_seconds(1));
    EXPECT_NEAR(m.velocity(), 20, 1.1) << "friction and dead band take a little";
    ASSERT_TRUE(m.axis->wait(whole_seconds(10)));
    EXPECT_NEAR(m.mm(), 150, 0.3);
}

TEST(ServoAxis, RejectsMovesWithValueAndLimitAndMovesNothing) {
    Machine m;
    const auto refused = [&](const Result<void>& done, const char* why) {
        ASSERT_FALSE(done);
        EXPECT_EQ(done.error().kind, ErrorKind::refused);
        EXPECT_THAT(done.error().message, HasSubstr(why));
    };
    refused(m.axis->move_to(200, 100), "not valid");
    m.here_is(100);
    refused(m.axis->move_to(2'901, 100), "outside its travel of -200 to 2900");
    refused(m.axis->move_by(-301, 100), "outside its travel");
    refused(m.axis->move_to(200, 501), "up to 500");
    refused(m.axis->move_to(200, 0), "above 0");
    refused(m.axis->move_to(std::nan(""), 100), "outside its travel");
    refused(m.axis->jog(-900, m.now()), "up to 500");
    refused(m.axis->set_position(1e9), "it must be -");
    refused(m.axis->home({}, m.now()), "above 0");
    ASSERT_TRUE(m.axis->move_to(200, 100));
    refused(m.axis->move_to(100, 100), "it moves");
    refused(m.axis->jog(10, m.now()), "it moves");
    refused(m.axis->set_position(0), "it moves");
    ASSERT_TRUE(m.axis->wait(whole_seconds(10)));
    EXPECT_NEAR(m.mm(), 200, 0.3);
}

TEST(ServoAxis, JogsForTheCommandedTime) {
    Machine m;
    m.here_is(100);
    const auto jog = [&](double velocity, int ms) {
        for (int i = 0; i < ms; i += 20) {
            ASSERT_TRUE(m.axis->jog(velocity, m.now()));
            m.run(milliseconds(20));
        }
    };
    jog(200, 1'000);
    EXPECT_EQ(m.axis->state(), AxisState::jogging);
    EXPECT_NEAR(m.velocity(), 200, 3);
    jog(50, 600);
    EXPECT_NEAR(m.velocity(), 50, 2) << "on the fly";
    jog(-100, 1'000);
    EXPECT_NEAR(m.velocity(), -100, 2) << "by way of a stop";
    m.run(milliseconds(1'000));
    EXPECT_EQ(m.axis->state(), AxisState::standstill) << "nobody asked any more";
    ASSERT_TRUE(m.axis->jog(300, m.now()));
    m.run(milliseconds(100));
    ASSERT_TRUE(m.axis->jog(0, m.now()));
    EXPECT_EQ(m.axis->state(), AxisState::stopping);
    ASSERT_TRUE(m.axis->wait(whole_seconds(5)));
    EXPECT_EQ(m.velocity(), 0);
}

TEST(ServoAxis, AJogEndsAtTheEndOfTheTravel) {
    Machine m;
    m.here_is(100);
    for (int i = 0; i < 100; ++i) {
        static_cast<void>(m.axis->jog(-400, m.now()));
        m.run(milliseconds(20));
    }
    EXPECT_NEAR(m.mm(), -200, 0.3);
    EXPECT_THAT(m.axis->jog(-400, m.now()).error().message, HasSubstr("end of its travel"));
}

TEST(ServoAxis, AStopDeceleratesAndAStopAtOnceIsShorterAndBothKeepThePosition) {
    double way[2] = {};
    for (const bool at_once : {false, true}) {
        Machine m;
        m.here_is(100);
        ASSERT_TRUE(m.axis->move_to(2'500, 500));
        m.run(whole_seconds(2));
        const double from = m.mm();
        EXPECT_NEAR(m.velocity(), 500, 3);
        at_once ? m.axis->stop_now() : m.axis->stop();
        ASSERT_TRUE(m.axis->wait(whole_seconds(5)));
        way[at_once] = m.mm() - from;
        EXPECT_TRUE(m.axis->position_valid());
        EXPECT_NEAR(m.axis->position(), m.mm(), 1e-9);
    }
    EXPECT_NEAR(way[0], 500.0 * 500 / 2 / 1000, 8) << "at 1000 mm/s2";
    EXPECT_NEAR(way[1], 500.0 * 500 / 2 / 5050, 2) << "at the amplifier's current limit";
}

TEST(ServoAxis, TheEndStopEndsAMoveAndAllowsTheOtherDirection) {
    Machine m;  // without a valid position no soft limit is active
    ASSERT_TRUE(m.axis->move_by(3'500, 300));
    const auto moved = m.axis->wait(whole_seconds(30));
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().kind, ErrorKind::machine);
    EXPECT_THAT(moved.error().message, HasSubstr("the right end stop is active"));
    EXPECT_EQ(m.axis->state(), AxisState::error);
    EXPECT_GT(m.mm(), 3'000);
    EXPECT_LT(m.mm(), 3'020);
    EXPECT_THAT(m.axis->move_by(10, 100).error().message, HasSubstr("right end stop; move it in - direction"));
    ASSERT_TRUE(m.axis->move_by(-500, 300));
    ASSERT_TRUE(m.axis->wait(whole_seconds(30)));
    EXPECT_EQ(m.axis->state(), AxisState::standstill);
}

TEST(ServoAxis, TheEmergencyStopEndsAMoveAndItStaysWhenReleased) {
    Machine m;
    m.here_is(100);
    ASSERT_TRUE(m.axis->move_to(2'500, 500));
    m.run(whole_seconds(1));
    ASSERT_TRUE(m.context.force("estop", 0));
    const auto moved = m.axis->wait(whole_seconds(30));
    ASSERT_FALSE(moved);
    EXPECT_THAT(moved.error().message, HasSubstr("the emergency stop is active"));
    EXPECT_EQ(*m.context.get("board.relay"), 0);
    EXPECT_EQ(m.velocity(), 0);
    EXPECT_THAT(m.axis->move_to(0, 100).error().message, HasSubstr("release it"));
    ASSERT_TRUE(m.context.force("estop", std::nan("")));
    const double there = m.mm();
    m.run(whole_seconds(1));
    EXPECT_EQ(m.mm(), there);
    EXPECT_TRUE(m.axis->position_valid());
    ASSERT_TRUE(m.axis->move_to(0, 500));
    ASSERT_TRUE(m.axis->wait(whole_seconds(30)));
    EXPECT_NEAR(m.mm(), 0, 0.3);
}

TEST(ServoAxis, ABrokenWireIsAStop) {
    for (const bool from_file : {true, false}) {
        Machine m(from_file ? carriage("", "[wires]\n\"board.esr\" = \"open\"\n") : carriage());
        m.here_is(100);
        if (!from_file) {
            ASSERT_TRUE(inject_fault(m.rack, "esr.broken", "board"));
        }
        m.run(milliseconds(2));
        EXPECT_THAT(m.axis->move_to(200, 100).error().message, HasSubstr("right end stop"));
        ASSERT_TRUE(m.axis->move_to(0, 100)) << "the other direction stays free";
        ASSERT_TRUE(m.axis->wait(whole_seconds(30)));
    }
}

TEST(ServoAxis, TheWatchdogsResetInvalidatesThePosition) {
    Machine m;
    m.here_is(100);
    ASSERT_TRUE(m.axis->move_to(2'500, 500));
    m.run(milliseconds(500));
    ASSERT_TRUE(inject_fault(m.rack, "watchdog.hang", "board"));
    const auto moved = m.axis->wait(whole_seconds(30));
    ASSERT_FALSE(moved);
    EXPECT_EQ(m.velocity(), 0);
    EXPECT_LT(m.mm(), 1'500) << "the watchdog reacts after a second";
    EXPECT_FALSE(m.axis->position_valid());
    ASSERT_TRUE(inject_fault(m.rack, "watchdog.hang=0", "board"));
}

TEST(ServoAxis, ALockedAxisReturnsAfterAPushAndAnUnlockedOneDoesNot) {
    for (const bool held : {true, false}) {
        Machine m(carriage(held ? "position_window_mm = 0.25\n" : ""));
        m.here_is(100);
        ASSERT_TRUE(m.axis->move_to(500, 500));
        ASSERT_TRUE(m.axis->wait(whole_seconds(30)));
        m.run(milliseconds(2));
        EXPECT_EQ(m.rack.card("board")->inspect("LOCKED").value(), held);
        ASSERT_TRUE(inject_fault(m.rack, "motor.push=1000", "X"));
        m.run(whole_seconds(3));
        EXPECT_NEAR(m.mm(), held ? 500 : 510, 0.5);
        ASSERT_TRUE(m.axis->move_to(200, 500)) << "the next move ends the lock";
        ASSERT_TRUE(m.axis->wait(whole_seconds(30)));
        EXPECT_NEAR(m.mm(), 200, 0.3);
    }
}

TEST(ServoAxis, HasQuantitiesOfVoltageAndCamAndFaultsOfItsServo) {
    Machine m;
    m.here_is(100);
    ASSERT_TRUE(m.axis->move_to(129, 50));
    m.run(milliseconds(250));
    EXPECT_NEAR(*get_quantity(m.rack, "X.drive_v"), 0.5, 0.01);
    EXPECT_EQ(*get_quantity(m.rack, "X.cam"), 0);
    EXPECT_EQ(*m.context.get("board.vout"), *get_quantity(m.rack, "X.drive_v"));
    ASSERT_TRUE(m.axis->wait(whole_seconds(30)));
    EXPECT_EQ(*get_quantity(m.rack, "X.cam"), 1);
    EXPECT_EQ(*m.context.get("X.cam"), 0) << "the contact is open on the cam";
    EXPECT_EQ(*m.context.get("board.ref"), 1);
    ASSERT_TRUE(inject_fault(m.rack, "motor.stall", "X"));
    ASSERT_TRUE(m.axis->move_to(200, 50));
    m.run(whole_seconds(1));
    EXPECT_NEAR(m.mm(), 129, 0.3);
    EXPECT_THAT(inject_fault(m.rack, "motor.lose_steps", "X").error().message, HasSubstr("no part with the fault"));
    EXPECT_THAT(inject_fault(m.rack, "watchdog.bark", "board").error().message, HasSubstr("watchdog.hang"));
    ASSERT_TRUE(set_quantity(m.rack, "X.position_mm", 180));
    EXPECT_NEAR(m.mm(), 180, 0.011);
    // Forces a voltage manually.
    m.axis->stop_now();
    ASSERT_TRUE(inject_fault(m.rack, "motor.stall=0", "X"));
    ASSERT_TRUE(m.context.force("X.drive", -2));
    m.host().pass(milliseconds(500));
    EXPECT_NEAR(m.velocity(), -200, 2);
    EXPECT_THAT(m.context.force("X.drive", 40).error().message, HasSubstr("-15 to 15 V"));
}

TEST(ServoAxis, AllHomingMethodsFindTheCamOrTheIndexUnderIt) {
    for (const bool plus : {false, true})
        for (int type = 1; type <= 4; ++type) {
            SCOPED_TRACE(fmt::format("type {} {}", type, plus ? "plus" : "minus"));
            Rack rack(
                good(carriage("", fmt::format("[axis.X.homing]\nsearch_direction = \"{}\"\n{}", plus ? "plus" : "minus",
                                              type >= 3 ? "home_offset_mm = 128\n" : ""))));
            rack.start();
            HomingSettings settings;
            settings.method = type;
            const HomingOutcome out = home_axes(rack, settings);
            ASSERT_TRUE(out.all_homed()) << out.axes[0].outcome.sentence;
            // The index pulses are at whole revolutions from the start at 100 mm; the one under the cam is at 130 mm.
            const double home = type >= 3 ? 130 : plus ? 126 : 132, called = type >= 3 ? 128 : plus ? 126 : 132;
            EXPECT_NEAR(out.axes[0].counter_position - called, out.axes[0].machine_position - home, 0.0101)
                << "to a count";
            if (type % 2 == 0) {
                EXPECT_NEAR(out.axes[0].counter_position, called, 0.05) << "it stands there";
            }
            EXPECT_THAT(homing_text(out), HasSubstr("the position is valid"));
        }
}

TEST(ServoAxis, AHomingThatFindsNoReferenceReportsItAndItsPositionIsNotValid) {
    for (const char* wires : {"[wires]\n\"board.ref\" = \"open\"\n", "[wires]\n\"board.ref\" = \"X.limit_plus\"\n"}) {
        const RackReading reading = read_rack_text(carriage("", wires));
        ASSERT_TRUE(reading.config);
        Rack rack(*reading.config);
        rack.start();
        const HomingOutcome out = home_axes(rack, {});
        EXPECT_FALSE(out.ended) << "refused: the cam is not wired";
        EXPECT_THAT(out.ended.error().message, HasSubstr("ref of card board"));
    }
    Machine m;
    ASSERT_TRUE(inject_fault(m.rack, "ref.broken", "board"));
    m.run(milliseconds(2));
    control::HomingRequest order = home_order(m.rack.config(), m.rack.config().axes[0]).value();
    ASSERT_TRUE(m.axis->home(order, m.now()));
    const auto homed = m.axis->wait(whole_seconds(60));
    ASSERT_FALSE(homed);
    EXPECT_THAT(homed.error().message, HasSubstr("right end stop is active and no reference was found"));
    EXPECT_FALSE(m.axis->position_valid());
    EXPECT_FALSE(m.axis->home_outcome().homed);
    // A stop in the middle is also accepted.
    ASSERT_TRUE(inject_fault(m.rack, "ref.broken=0", "board"));
    ASSERT_TRUE(m.axis->home(order, m.now()));
    m.run(milliseconds(300));
    EXPECT_EQ(m.axis->state(), AxisState::homing);
    m.axis->stop();
    EXPECT_THAT(m.axis->home_outcome().sentence, HasSubstr("stopped in SEARCH"));
    ASSERT_TRUE(m.axis->wait(whole_seconds(5)));
    EXPECT_EQ(m.velocity(), 0);
}

TEST(ServoAxis, AnEmergencyStopEndsAHoming) {
    Machine m;
    control::HomingRequest order = home_order(m.rack.config(), m.rack.config().axes[0]).value();
    order.towards_plus = false;
    ASSERT_TRUE(m.axis->home(order, m.now()));
    m.run(milliseconds(200));
    ASSERT_TRUE(m.context.force("estop", 0));
    const auto homed = m.axis->wait(whole_seconds(10));
    ASSERT_FALSE(homed);
    EXPECT_THAT(homed.error().message, HasSubstr("the emergency stop is active"));
    EXPECT_THAT(m.axis->home(order, m.now()).has_value(), true) << "it begins and says why it ended";
    EXPECT_THAT(m.axis->home_outcome().sentence, HasSubstr("Nothing was moved"));
}

}  // namespace
}  // namespace motionrack::rack
