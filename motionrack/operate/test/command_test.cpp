// Commands of a machine: invalid numbers, full queues, and starts that are permanently forbidden.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <motionrack/cards/ioflex02/map.hpp>
#include <utility>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::HasSubstr;

template <class T>
std::string said_of(const T& outcome) {
    return outcome ? std::string() : outcome.error().message;
}

TEST(Machine, RefusesNumbersThatAreNoMotionAndNoPosition) {
    Operated o(two_axes());
    const double none = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
    o.at(0.1, [=](Machine& m) {
        EXPECT_EQ(refusal_of(m.manual().jog('X', none)), "Not jogged: the jog speed is not a number.");
        for (const Result<void>& refused :
             {m.manual().jog_by('X', endless, 5), m.manual().jog_by('X', 1, 0), m.manual().jog_by('X', 1, none)})
            EXPECT_THAT(refusal_of(refused), HasSubstr("is not a motion"));
        for (const double speed : {none, endless, -1.0})
            EXPECT_THAT(refusal_of(m.manual().jog_to({20}, speed)), HasSubstr("Not jogged: a jog speed of"));
        EXPECT_THAT(refusal_of(m.manual().jog_to({none}, 5)), HasSubstr("nan is not a position of it"));
        EXPECT_THAT(refusal_of(m.manual().jog_to({-1}, 5)), HasSubstr("axis X goes from 0 to 300, not to -1"));
        EXPECT_EQ(refusal_of(m.manual().set_position('X', none)), "The position was not set: it is not a number.");
        EXPECT_EQ(refusal_of(touch_off(m, 'X', endless)), "The work offset was not set: the value is not a number.");
        EXPECT_EQ(refusal_of(m.manual().jog_to({10}, 5)), "") << "it is there";
        EXPECT_EQ(m.state(), MachineState::standstill);
    });
    o.run(0.3);
    EXPECT_EQ(o.x(), 10);
}

TEST(Machine, JogsByMoreThanItsTravelOnlyWithoutAValidPosition) {
    Operated o(router());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 100'000, 10)); });
    o.at(0.2, [](Machine& m) { m.cancel(); });
    o.at(0.5, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 50)); });
    o.at(0.6, [](Machine& m) {
        EXPECT_THAT(refusal_of(m.manual().jog_by('X', 100'000, 10)), HasSubstr("but the travel of axis X is"));
    });
    o.run(0.7);
}

TEST(Machine, RefusesJogsAndLinesThatItsQueueDoesNotHold) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        std::string said;
        int accepted = 0;
        for (; said.empty() && accepted < 5000; ++accepted)
            said = refusal_of(m.manual().jog_to({accepted % 2 == 0 ? 20.0 : 30.0}, 20));
        EXPECT_EQ(said, "Not jogged: the queue of jogs is full; wait for earlier jogs.");
        EXPECT_GT(accepted, 100);
        m.cancel();
    });
    o.at(0.5, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        std::string said;
        for (int i = 1; said.empty() && i < 5000; ++i)
            said = said_of(m.line(i % 2 == 0 ? "G1 X20 F600" : "G1 X30 F600", i));
        EXPECT_EQ(said, "The line was not accepted: the queue is full until earlier lines are executed.");
        m.cancel();
    });
    o.at(1, [](Machine& m) {
        EXPECT_TRUE(m.begin_program("G21 G90 F600\nG1 X40\nM2\n", "p"));
        EXPECT_EQ(said_of(m.line("G1 X20", 1)),
                  "The line was not accepted: a program runs. Stop it or wait for its end.");
    });
    o.run(1.1);
}

TEST(Machine, HasNoStartAfterTheyWereForbiddenButJogs) {
    Operated o(two_axes("[card.glass]\ntype = \"ioflex02\"\nbase_address = 0x2300\n"));
    o.at(0.1, [](Machine& m) {
        m.forbid_starts("journal", "The disk is full.");
        m.forbid_starts("journal", "It is full, too.");
        const auto why = HasSubstr(": The disk is full.");
        EXPECT_THAT(refusal_of(m.begin_program("G0 X20\n", "p")), why);
        EXPECT_THAT(said_of(m.line("G0 X20", 1)), why);
        EXPECT_THAT(refusal_of(m.manual().home("X")), why);
        EXPECT_THAT(refusal_of(m.service().begin("m", {}, "", {})), why);
        EXPECT_THAT(refusal_of(m.manual_access().request({"m", 16, 0, 0}, {})), why);
        EXPECT_THAT(refusal_of(m.manual_access().request({"glass", 16, 0x2300 + ioflex02::offset("OUTL"), 0}, {})),
                    why);
        EXPECT_TRUE(m.manual().jog_by('X', 5, 20));
    });
    o.at(1, [](Machine& m) { m.reset(); });
    o.run(1.2);
    EXPECT_NEAR(o.x(), 15, 1e-9);
    ASSERT_THAT(o.machine->status().alarms, testing::SizeIs(1)) << "the first reason";
    EXPECT_EQ(o.machine->status().alarms[0].text, "The disk is full.");
    EXPECT_TRUE(o.machine->status().alarms[0].active) << "no reset ends it";
}

TEST(Machine, ResumesNoHoldAfterStartsWereForbiddenInIt) {
    Operated o(two_axes());
    double held = 0;
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X80\n", "p")); });
    o.at(0.6, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    o.at(1, [&](Machine& m) {
        held = o.x();
        m.forbid_starts("journal", "The disk is full.");
        EXPECT_EQ(m.state(), MachineState::hold);
        EXPECT_EQ(refusal_of(m.resume()), "Not resumed: The disk is full.");
    });
    o.run(1.5);
    EXPECT_EQ(o.x(), held);
}

TEST(Machine, EndsAJogWhenStartsAreForbidden) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 100, 20)); });
    o.at(0.5, [](Machine& m) { m.forbid_starts("journal", "The disk is full."); });
    o.run(1);
    EXPECT_LT(o.stood_since, 0.6);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
}

TEST(Machine, SwitchesNoCoolantWhileAStopIsInForce) {
    Operated o(two_axes());
    const auto coolant = [](const Machine& m) { return std::pair(m.status().mist, m.status().flood); };
    o.at(0.1, [=](Machine& m) {
        m.set_coolant(true, false);
        EXPECT_EQ(coolant(m), std::pair(true, false));
        m.set_coolant(false, true);
        EXPECT_EQ(coolant(m), std::pair(false, true));
        m.stop();
        EXPECT_EQ(coolant(m), std::pair(false, false));
        m.set_coolant(true, true);
        EXPECT_EQ(coolant(m), std::pair(false, false));
        m.reset();
    });
    o.at(0.2, [=](Machine& m) {
        m.set_coolant(true, true);
        EXPECT_EQ(coolant(m), std::pair(true, true));
    });
    o.run(0.3);
}

TEST(Machine, SwitchesCoolantOffButNotOnWhileNothingMayBegin) {
    const auto coolant = [](const Machine& m) { return std::pair(m.status().mist, m.status().flood); };
    for (const bool door : {true, false}) {
        SCOPED_TRACE(door ? "the door is open" : "starts are forbidden");
        Operated o(two_axes("[safety]\ndoor = true\n"));
        o.at(0.1, [=](Machine& m) {
            m.set_coolant(true, false);
            if (door) {
                EXPECT_TRUE(m.wires().force("door", 0));
            } else {
                m.forbid_starts("journal", "The disk is full.");
            }
        });
        o.at(0.2, [=](Machine& m) {
            EXPECT_EQ(coolant(m), std::pair(!door, false));
            m.set_coolant(!door, true);
            EXPECT_EQ(coolant(m), std::pair(!door, false));
            m.set_coolant(false, false);
            EXPECT_EQ(coolant(m), std::pair(false, false));
            m.set_coolant(true, false);
            EXPECT_EQ(coolant(m), std::pair(false, false));
            EXPECT_TRUE(m.wires().force("door", 1));
            m.set_coolant(true, true);
            EXPECT_EQ(coolant(m), std::pair(door, door));
        });
        o.run(0.3);
    }
}

TEST(Machine, StandsStillWhereAnAxisToHomeIsUnknown) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().home("Q")); });
    o.run(0.5);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
    EXPECT_THAT(o.machine->status().reason, HasSubstr("The rack has no axis"));
    EXPECT_TRUE(o.machine->status().alarms.empty());
}

TEST(Machine, ReportsTheCommandedPositionAsTheActualOneOfAnAxisWithoutAnEncoder) {
    Operated o(two_axes("encoder_counts_per_rev = 0\n"));
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('Y', 5, 20)); });
    o.run(1);
    EXPECT_EQ(o.y(), 5);
    EXPECT_EQ(o.machine->status().axes[1].actual, 5);
}

/// The check of the program assumes that the probe touches.
TEST(Machine, FailsAtALineThatAMissingContactHasMadeImpossible) {
    Operated o(*rack::read_rack_file((source_root / "examples/16_probe/machine.toml").string()).config);
    o.at(0.2, [](Machine& m) {
        EXPECT_TRUE(m.begin_program("G21 G90\nG38.3 X20 F1200\no1 if [#5070 EQ 0]\nG1 X9999\no1 endif\nG1 X30\nM2\n",
                                    "touch.ngc"));
    });
    o.at(2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        ASSERT_THAT(m.status().alarms, testing::SizeIs(1));
        EXPECT_THAT(m.status().alarms[0].source, HasSubstr("touch.ngc, line"));
        EXPECT_THAT(m.status().alarms[0].text, HasSubstr("9999"));
        EXPECT_NEAR(m.status().axes[0].commanded, 20, 1e-2);
        EXPECT_THAT(refusal_of(m.manual().jog('X', 5)), HasSubstr("the machine is in error stop; see its alarm"));
        m.reset();
    });
    o.at(2.1, [](Machine& m) { EXPECT_TRUE(m.line("G90 G0 X25", 1)); });
    o.run(3);
    EXPECT_NEAR(o.x(), 25, 1e-2);
}

TEST(Machine, HoldsAfterAProbingMoveOnlyWhereALineFollows) {
    Operated o(*rack::read_rack_file((source_root / "examples/16_probe/machine.toml").string()).config);
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90\nG38.3 X20 F1200\nG1 X25\nM2\n", "touch.ngc")); });
    o.at(0.6, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    o.at(3, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::hold);
        EXPECT_NEAR(m.status().axes[0].commanded, 20, 1e-2);
        EXPECT_TRUE(m.resume());
    });
    o.at(4, [&](Machine& m) {
        EXPECT_NEAR(o.x(), 25, 1e-2);
        EXPECT_TRUE(m.line("G90 G38.3 X5 F1200", 1));
    });
    o.at(4.5, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    o.at(6, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_NEAR(o.x(), 5, 1e-2);
        EXPECT_TRUE(m.line("G90 G1 X10 F1200", 2));
    });
    o.run(7);
    EXPECT_NEAR(o.x(), 10, 1e-2);
}

/// More lines than the queue takes, so that the impossible one is read while those before it are executed.
std::string line_read_in_motion() {
    std::string program = "G21 G90\nG38.3 X20 F1200\n";
    for (int i = 1; i <= 1700; ++i) program += fmt::format("G1 X{:.2f} F3000\n", 20 + 0.13 * i);
    return program + "o1 if [#5070 EQ 0]\nG1 X9999\no1 endif\nM2\n";
}

TEST(Machine, StandsBeforeTheErrorStopOfALineThatItReadsInMotion) {
    for (const bool resets : {false, true}) {
        SCOPED_TRACE(resets);
        Operated o(*rack::read_rack_file((source_root / "examples/16_probe/machine.toml").string()).config);
        o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.begin_program(line_read_in_motion(), "touch.ngc")); });
        bool was_idle = false, has_moved = false, is_reset = false;
        double x = 0, moved_idle = 0;
        o.each_status([&](const Status& status) {
            const bool is_idle = idle(status.state);
            if (is_idle && was_idle) moved_idle += std::fabs(status.axes[0].commanded - x);
            was_idle = is_idle;
            x = status.axes[0].commanded;
            has_moved = has_moved || status.state == MachineState::moving;
            if (resets && has_moved && status.state != MachineState::moving && !std::exchange(is_reset, true))
                o.machine->reset();
        });
        o.run(12);
        EXPECT_EQ(moved_idle, 0) << "it braked in the error stop";
        EXPECT_EQ(o.machine->state(), resets ? MachineState::standstill : MachineState::error_stop);
        EXPECT_THAT(o.states, testing::Contains("stopping"));
        EXPECT_GT(x, 21) << "it moved";
        EXPECT_LT(x, 240) << "lines before it were left out";
        ASSERT_THAT(o.machine->status().alarms, testing::SizeIs(1));
        EXPECT_THAT(o.machine->status().alarms[0].source, HasSubstr("touch.ngc, line"));
        EXPECT_THAT(o.machine->status().alarms[0].text, HasSubstr("9999"));
    }
}

TEST(StopReport, GivesTheReasonOfTheFirstNamedStop) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X80\n", "p")); });
    o.at(0.6, [](Machine& m) {
        m.cancel();
        EXPECT_EQ(m.status().reason, "");
        m.cancel({"anna", "10.0.0.5", "^X"});
        m.cancel({"bert", "", "^X"});
        EXPECT_EQ(m.status().reason, "^X by anna (10.0.0.5): machine was stopped.");
    });
    o.run(1);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
    EXPECT_EQ(o.machine->status().reason, "^X by anna (10.0.0.5): machine was stopped.");
}

TEST(Machine, EndsWhileItsTimeStandsStill) {
    bool stands_still = false;
    MachineSettings settings;
    settings.pace = [&](Instant) { return !stands_still; };
    const auto machine = std::move(*Machine::make(two_axes(), std::move(settings)));
    stands_still = true;
    machine->quit();
    machine->run();
    EXPECT_TRUE(machine->status().ended);
}

/// Sets the positions of all axes to their true positions.
void set_true_positions(Machine& m) {
    for (const AxisStatus& axis : m.status().axes)
        EXPECT_TRUE(m.manual().set_position(axis.letter, axis.true_position));
}

TEST(TouchOff, GivesThePresentPositionOfAnAxisItsValueInMillimetresOrDegrees) {
    Operated o(router());
    o.at(0.05, set_true_positions);
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(touch_off(m, 'X', 5));
        EXPECT_TRUE(m.line("G20", 1));
    });
    o.at(0.3, [](Machine& m) { EXPECT_TRUE(touch_off(m, 'Y', 25.4)); });
    o.at(0.4, [](Machine& m) { EXPECT_TRUE(touch_off(m, 'A', 90)); });
    o.at(0.5, [](Machine& m) {
        const std::vector<AxisStatus>& axes = m.status().axes;
        const control::Point& offset = m.stream().interpreter().frame().offset;
        EXPECT_NEAR(offset[0], axes[0].commanded - 5, 1e-6);
        EXPECT_NEAR(offset[1], axes[1].commanded - 25.4, 1e-6);
        EXPECT_NEAR(offset[3], axes[3].commanded - 90, 1e-6);
        EXPECT_TRUE(m.programs().clear_offsets());
        EXPECT_EQ(m.stream().interpreter().frame().offset, control::Point{});
    });
    o.run(0.6);
}

TEST(TouchOff, IsRefusedInMotionAndWithoutAValidPosition) {
    Operated o(router());
    o.at(0.05, [](Machine& m) {
        EXPECT_EQ(refusal_of(touch_off(m, 'Q', 5)), "The work offset was not set: the machine has no axis Q.");
        EXPECT_THAT(refusal_of(touch_off(m, 'X', 5)), HasSubstr("the position of axis X is not valid"));
        set_true_positions(m);
    });
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.line("G91 G1 X5 F600", 1));
        EXPECT_THAT(refusal_of(touch_off(m, 'X', 5)), HasSubstr("The work offset was not set: the machine moves."));
        EXPECT_THAT(refusal_of(m.programs().clear_offsets()),
                    HasSubstr("The work offsets were not changed: the machine moves."));
    });
    o.run(1);
}

}  // namespace
}  // namespace motionrack::operate
