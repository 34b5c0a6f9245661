// States in which a machine refuses motion: disabled, or stopped by a switch or the emergency stop.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Machine, IsDisabledAtFirstAndRejectsMotion) {
    auto machine = *Machine::make(two_axes(), {});
    EXPECT_EQ(machine->state(), MachineState::disabled);
    EXPECT_THAT(machine->manual().jog('X', 5).error().message, HasSubstr("enable it first"));
    EXPECT_THAT(machine->line("G1 X20 F600", 1).error().message, HasSubstr("enable it first"));
    EXPECT_THAT(machine->begin_program("G0 X1\n", "p").error().message, HasSubstr("disabled"));
}

TEST(Machine, HasNoValidPositionAfterAnEmergencyStopAndNeedsAReset) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F3000\nG1 X90\n", "p")); });
    o.at(1, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
    o.at(2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_FALSE(m.status().axes[0].position_valid);
        ASSERT_EQ(m.status().alarms.size(), 1u);
        EXPECT_THAT(m.status().alarms[0].text, HasSubstr("emergency"));
        EXPECT_EQ(m.status().alarms[0].source, "emergency stop");
        EXPECT_FALSE(m.line("G1 X1 F600", 1));
        m.reset();
    });
    o.at(3, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << "it is still pressed";
        EXPECT_THAT(m.status().reason, HasSubstr("still pressed"));
        EXPECT_TRUE(m.wires().force("estop", 1));
        m.reset();
    });
    o.at(4, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_FALSE(m.status().alarms[0].active);
        EXPECT_TRUE(m.acknowledge_alarm(1));
        EXPECT_FALSE(m.acknowledge_alarm(7));
        EXPECT_THAT(m.line("G1 X1 F600", 1).error().message, HasSubstr("not valid"));
    });
    o.run(5);
}

TEST(Machine, ReportsWhenTheEmergencyStopIsPressedAtAStandstill) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
    o.run(1);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "error stop"));
    EXPECT_EQ(o.machine->status().alarms.size(), 1u);
    EXPECT_TRUE(o.machine->status().axes[0].position_valid) << "nothing moved";
}

TEST(Machine, StopsWithAnAlarmAtALimitSwitchAndKeepsItsPosition) {
    Operated o(two_axes("[axis.X.switches]\nlimit_plus_mm = 40\n"));
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X80\n", "p")); });
    o.run(6);
    EXPECT_EQ(o.states.back(), "error stop");
    EXPECT_THAT(o.machine->status().alarms[0].text, HasSubstr("limit"));
    EXPECT_EQ(o.machine->status().alarms[0].source, "p, line 2");
    EXPECT_TRUE(o.machine->status().axes[0].position_valid);
    EXPECT_LT(o.x(), 42);
}

TEST(Machine, DisabledWhileItMovesStopsFirst) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F3000\nG1 X90\n", "p")); });
    o.at(1, [](Machine& m) { EXPECT_TRUE(m.enable(false)); });
    o.run(2);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "moving", "stopping", "disabled"));
    EXPECT_LT(o.stood_since, 1.5);
}

TEST(Machine, MovesNoAxisThatIsDisabled) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.enable(false, "Y")); });
    o.at(0.2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_TRUE(m.status().axes[0].enabled);
        EXPECT_FALSE(m.status().axes[1].enabled);
        EXPECT_EQ(m.manual().jog_by('Y', 5, 10).error().message,
                  "Not jogged: axis Y is disabled; enable it first. Nothing was moved.");
        EXPECT_THAT(m.begin_program("G21 G90 F600\nG1 X20\n", "p").error().message, HasSubstr("axis Y is disabled"));
        EXPECT_THAT(m.line("G0 X1", 1).error().message, HasSubstr("axis Y is disabled"));
        EXPECT_THAT(m.enable(true, "XQ").error().message, HasSubstr("no axis Q"));
        EXPECT_TRUE(m.manual().jog('X', 10));
        EXPECT_THAT(m.manual().jog('Y', 10).error().message,
                    HasSubstr("axis Y is disabled"));  // even while another axis jogs
    });
    o.at(1, [](Machine& m) { EXPECT_TRUE(m.enable(false, "X")); });
    o.at(1.2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::disabled);
        EXPECT_TRUE(m.enable(true, "Y"));
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_TRUE(m.manual().jog_by('Y', 5, 10));
    });
    o.run(3);
    EXPECT_GT(o.x(), 10);
    EXPECT_DOUBLE_EQ(o.y(), 5);
}

TEST(Machine, RejectsAnImpossibleJogInTheAnswerToTheCommand) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_THAT(refusal_of(m.manual().jog('X', 1e6)), HasSubstr("the jog speed is 1e+06 mm/s; it must be at most"));
        EXPECT_THAT(refusal_of(m.manual().jog('X', -1e6)), HasSubstr("Nothing was moved"));
        EXPECT_THAT(refusal_of(m.manual().jog_by('X', 1, 1e6)),
                    HasSubstr("the jog speed is 1e+06 mm/s; it must be at most"));
        EXPECT_THAT(refusal_of(m.manual().jog_by('X', -1e6, 5)), HasSubstr("the distance is 1e+06 mm, but the travel"));
        EXPECT_EQ(m.state(), MachineState::standstill);
    });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 1, 5)); });
    o.run(1);
    EXPECT_DOUBLE_EQ(o.x(), 11);
}

TEST(Machine, RefusesAProgramWithoutAnyWord) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_THAT(m.begin_program("; nothing\n", "p").error().message, HasSubstr("the program is empty"));
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_TRUE(m.begin_program("G21\n", "p"));
    });
    o.run(1);
}

TEST(Machine, StaysDisabledWhenResetAfterAnError) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.enable(false)); });
    o.at(0.3, [](Machine& m) {
        EXPECT_TRUE(m.wires().force("estop", 1));
        m.reset();
    });
    o.run(0.5);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "error stop", "disabled"));
}

}  // namespace
}  // namespace motionrack::operate
