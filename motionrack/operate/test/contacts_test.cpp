// Contacts of a machine: limit switches wired wrongly, an emergency stop with two channels, a door.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Limit switches of X with exchanged wires; X is at 10 mm, and its + switch at 40 mm.
const std::string swapped_limits =
    "[axis.X.switches]\nlimit_minus_mm = -5\nlimit_plus_mm = 40\nhome_mm = 0\n"
    "[wires]\n\"m.xlmtp\" = \"X.limit_minus\"\n\"m.xlmtm\" = \"X.limit_plus\"\n";

std::string last_alarm(const Machine& m) {
    return m.status().alarms.empty() ? std::string() : m.status().alarms.back().text;
}

class SwappedLimits : public testing::TestWithParam<bool> {};

TEST_P(SwappedLimits, StopAnAxisBehindWhichOneBecomesActive) {
    Operated o(two_axes(swapped_limits));
    o.at(0.02, set_all_positions);
    o.at(0.1, [](Machine& m) {
        if (GetParam()) {
            EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X80\nM2\n", "p"));
        } else {
            EXPECT_TRUE(m.manual().jog_by('X', 70, 20));
        }
    });
    o.at(3, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << name_of(m.state());
        EXPECT_NEAR(m.status().axes[0].true_position, 40, 2) << "it stops with its ramp";
        EXPECT_THAT(last_alarm(m), HasSubstr("The - limit switch of X became active while X moved in + direction"));
        EXPECT_THAT(last_alarm(m), HasSubstr("wiring"));
        EXPECT_TRUE(m.status().axes[0].position_valid) << "a ramp loses nothing";
        EXPECT_FALSE(m.manual().jog('X', 5)) << "neither way before a reset";
        EXPECT_FALSE(m.manual().jog('X', -5));
        m.reset();
    });
    o.at(3.5, [](Machine& m) { EXPECT_EQ(m.state(), MachineState::standstill); });
    o.run(4);
}

TEST_P(SwappedLimits, StopAHomingToo) {
    if (!GetParam()) GTEST_SKIP();
    Operated o(
        two_axes("[axis.X.switches]\nlimit_minus_mm = 2\nlimit_plus_mm = 40\nhome_mm = "
                 "3\n[axis.X.homing]\nsearch_velocity_mm_s = 10\n"
                 "[wires]\n\"m.xlmtp\" = \"X.limit_minus\"\n\"m.xlmtm\" = \"X.limit_plus\"\n\"m.xin0\" = \"open\"\n"
                 "\"m.xin1\" = \"X.home\"\n"));
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.wires().force("X.home", 1)); });
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().home("X")); });
    o.at(4, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << name_of(m.state());
        EXPECT_GT(m.status().axes[0].true_position, 0) << "it does not run on into its end";
    });
    o.run(4.1);
    EXPECT_THAT(last_alarm(*o.machine), HasSubstr("+ limit switch of X became active while X moved in - direction"));
}

INSTANTIATE_TEST_SUITE_P(InAProgramAndAJog, SwappedLimits, testing::Bool());

const std::string two_channels = "[safety]\nestop_channels = 2\n";

/// A jog stopped at 1 s by one channel or the other.
class OneChannel : public testing::TestWithParam<const char*> {};

TEST_P(OneChannel, OfTheEmergencyStopStopsAtOnceAndIsNotResetWhileTheOtherDiffers) {
    const char* const channel = GetParam();
    Operated o(two_axes(two_channels));
    o.at(0.02, set_all_positions);
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 70, 20)); });
    o.at(1, [channel](Machine& m) { EXPECT_TRUE(m.wires().force(channel, 0)); });
    o.at(1.01, [](Machine& m) { EXPECT_EQ(m.status().axes[0].velocity, 0) << "the first contact acts at once"; });
    o.at(1.4, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_THAT(m.status().alarms, testing::SizeIs(1)) << "contacts may be unlike for half a second";
    });
    o.at(1.6, [](Machine& m) {
        EXPECT_THAT(last_alarm(m), HasSubstr("have differed for 500 ms at 1.5"));
        m.reset();
    });
    o.at(1.8, [channel](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << "a reset alone does not clear it";
        EXPECT_THAT(m.status().reason, HasSubstr("differ"));
        EXPECT_TRUE(m.wires().force(channel, 1));
        m.reset();
    });
    o.at(2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill) << m.status().reason;
        EXPECT_THAT(m.status().alarms, testing::SizeIs(2)) << "each is told once";
    });
    o.run(2.1);
}

INSTANTIATE_TEST_SUITE_P(Wires, OneChannel, testing::Values("estop1", "estop2"));

TEST(TwoChannels, ThatOpenTogetherAreAPressedButtonAndNoFault) {
    Operated o(two_axes(two_channels));
    o.at(0.02, set_all_positions);
    o.at(1, [](Machine& m) {
        EXPECT_TRUE(m.wires().force("estop1", 0));
        EXPECT_TRUE(m.wires().force("estop2", 0));
    });
    o.at(2, [](Machine& m) {
        EXPECT_THAT(m.status().alarms, testing::SizeIs(1));
        EXPECT_TRUE(m.wires().force("estop1", 1));
        EXPECT_TRUE(m.wires().force("estop2", 1));
        m.reset();
    });
    o.at(2.2, [](Machine& m) { EXPECT_EQ(m.state(), MachineState::standstill); });
    o.run(2.3);
}

const std::string with_door = "[safety]\ndoor = true\n";

void open_door(Machine& m, bool open) {
    EXPECT_TRUE(m.wires().force("door", open ? 0 : 1));
}

TEST(Door, OpenedDuringAProgramHoldsTheFeedAndStopsTheSpindle) {
    Operated o(two_axes(with_door));
    o.at(0.02, set_all_positions);
    double held = 0;
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200 M3 S1000\nG1 X60\nM2\n", "p")); });
    o.at(1, [](Machine& m) {
        EXPECT_EQ(m.status().spindle, control::gcode::Spindle::clockwise);
        open_door(m, true);
    });
    o.at(1.3, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::hold) << name_of(m.state());
        EXPECT_EQ(m.status().spindle, control::gcode::Spindle::off);
        EXPECT_THAT(last_alarm(m), HasSubstr("The door was opened at 1.0"));
        held = m.status().axes[0].commanded;
        EXPECT_THAT(m.resume().error().message, HasSubstr("the door is open"));
        open_door(m, false);
    });
    o.at(1.6, [&](Machine& m) {
        EXPECT_EQ(m.status().axes[0].commanded, held) << "closing it moves nothing";
        EXPECT_TRUE(m.resume());
    });
    o.at(1.8, [](Machine& m) { EXPECT_EQ(m.status().spindle, control::gcode::Spindle::clockwise); });
    o.run(6);
    EXPECT_NEAR(o.x(), 60, 1e-3);
    EXPECT_THAT(o.machine->status().alarms, testing::SizeIs(1));
}

TEST(Door, OpenedAgainInAHoldKeepsTheSpindleOfTheProgram) {
    Operated o(two_axes(with_door));
    o.at(0.02, set_all_positions);
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200 M3 S1000 M7\nG1 X60\nM2\n", "p")); });
    for (const double seconds : {1.0, 1.4}) {
        o.at(seconds, [](Machine& m) { open_door(m, true); });
        o.at(seconds + 0.2, [](Machine& m) {
            EXPECT_EQ(m.status().spindle, control::gcode::Spindle::off);
            EXPECT_FALSE(m.status().mist);
            open_door(m, false);
        });
    }
    o.at(1.8, [](Machine& m) { EXPECT_TRUE(m.resume()); });
    o.at(2, [](Machine& m) {
        EXPECT_EQ(m.status().spindle, control::gcode::Spindle::clockwise);
        EXPECT_TRUE(m.status().mist);
        EXPECT_THAT(m.status().alarms, testing::SizeIs(2)) << "one an opening";
    });
    o.run(6);
    EXPECT_NEAR(o.x(), 60, 1e-3);
}

/// The program switches spindle and flood at 40 mm, in the middle of a motion; the door opens just before.
TEST(Door, KeepsOffWhatAProgramSwitchesOnWhileItDeceleratesAndOnAfterTheResume) {
    std::ptrdiff_t passed = 0;
    for (const char* const profile : {"trapezoid", "jerk_limited"}) {
        SCOPED_TRACE(profile);
        rack::RackConfig config = two_axes(with_door);
        config.controller.profile = profile;
        Operated o(config);
        bool opened = false, resumed = false;
        o.each_status([&](const Status& status) {
            if (opened && !resumed) {
                EXPECT_FALSE(status.flood || status.mist) << "at " << to_seconds(status.at);
                EXPECT_EQ(status.spindle, control::gcode::Spindle::off);
            }
            if (opened || status.axes[0].commanded < 39.5) return;
            open_door(*o.machine, true);
            opened = true;
        });
        o.at(0.02, set_all_positions);
        o.at(0.1, [](Machine& m) {
            EXPECT_TRUE(m.begin_program("G21 G90 G64 F3000 M7\nG1 X40\nM4 S500 M8\nG1 X80 Y2\nM2\n", "p"));
        });
        o.at(1.5, [&](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::hold) << name_of(m.state());
            passed += std::count(o.events.begin(), o.events.end(), control::gcode::CanonCallKind::coolant) - 1;
            open_door(m, false);
        });
        o.at(1.6, [&](Machine& m) {
            resumed = true;
            EXPECT_TRUE(m.resume());
        });
        o.at(1.8, [](Machine& m) {
            EXPECT_EQ(m.status().spindle, control::gcode::Spindle::counter_clockwise);
            EXPECT_TRUE(m.status().flood && m.status().mist);
        });
        o.run(5);
        EXPECT_NEAR(o.x(), 80, 1e-3);
    }
    EXPECT_GT(passed, 0) << "events passed behind the open door";
}

TEST(Door, OpenedInAHoldRestoresTheCoolantThatWasSwitchedLast) {
    Operated o(two_axes(with_door));
    o.at(0.02, set_all_positions);
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200 M7 M8\nG1 X60\nM2\n", "p")); });
    o.at(1, [](Machine& m) { open_door(m, true); });
    o.at(1.2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::hold) << name_of(m.state());
        m.set_coolant(true, false);
        EXPECT_FALSE(m.status().mist || m.status().flood);
        m.set_coolant(false, false);
        open_door(m, false);
    });
    o.at(1.3, [](Machine& m) {
        m.set_coolant(true, false);
        EXPECT_TRUE(m.status().mist) << "the door is closed";
        EXPECT_TRUE(m.resume());
        EXPECT_TRUE(m.status().mist);
        EXPECT_FALSE(m.status().flood);
    });
    o.run(1.5);
}

TEST(Door, OpenedDuringAJogStopsItAndPreventsStartsUntilItIsClosed) {
    Operated o(two_axes(with_door + "[axis.X.switches]\nhome_mm = 0\n"));
    o.at(0.02, set_all_positions);
    double stood = 0;
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 70, 20)); });
    o.at(1, [](Machine& m) { open_door(m, true); });
    o.at(1.2, [&](Machine& m) {
        stood = m.status().axes[0].commanded;
        EXPECT_LT(stood, 50);
        for (const Result<void>& refused :
             {m.manual().jog('X', 5), m.manual().jog_by('X', 5, 5), m.manual().home("X"),
              m.begin_program("G0 X1\n", "p"), m.manual().jog_to({20, 0, 0, 0, 0, 0}, 5)}) {
            ASSERT_FALSE(refused);
            EXPECT_THAT(refused.error().message, HasSubstr("the door is open"));
        }
        EXPECT_THAT(m.line("G0 X1", 1).error().message, HasSubstr("the door is open"));
    });
    o.at(2, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_EQ(m.status().axes[0].commanded, stood);
        open_door(m, false);
        EXPECT_TRUE(m.manual().jog_by('X', 5, 20));
    });
    o.run(3);
    EXPECT_NEAR(o.x(), stood + 5, 0.01);
}

TEST(MachineWithoutContacts, HasNoWiresForThem) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        for (const char* wire : {"door", "estop1", "estop2"}) EXPECT_FALSE(m.wires().force(wire, 0)) << wire;
    });
    o.run(0.2);
    EXPECT_THAT(o.machine->status().alarms, IsEmpty());
}

}  // namespace
}  // namespace motionrack::operate
