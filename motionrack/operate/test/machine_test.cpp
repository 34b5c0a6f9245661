// An operated machine: programs, hold, stop, jog, homing; commands come at given instants of virtual time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Machine, ExecutesAProgramToItsEnd) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.begin_program("%\nG21 G90 F1200\nG1 X30\nG2 X40 Y10 I10\nM2\nG1 X0\n", "p.ngc"));
    });
    o.run(10);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "moving", "standstill"));
    EXPECT_NEAR(o.x(), 40, 0.5 / 640);
    EXPECT_NEAR(o.y(), 10, 0.5 / 640);
    EXPECT_NEAR(o.machine->status().axes[0].actual, 40, 1.0 / 640);
    EXPECT_EQ(o.machine->status().line, 5);
    EXPECT_THAT(o.events, testing::Contains(control::gcode::CanonCallKind::end));
}

TEST(Machine, ReportsNoLineOfThePreviousProgramWhenAnotherBegins) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X30\nG1 X20\n", "first.ngc")); });
    o.at(5, [](Machine& m) {
        EXPECT_EQ(m.status().line, 3);
        EXPECT_TRUE(m.begin_program("G21 G90 F60\nG1 X30\nG1 X20\nM2\n", "second.ngc"));
    });
    std::vector<std::int32_t> lines;
    o.machine->listen([&](const Status& status) {
        if (status.program == "second.ngc" && (lines.empty() || lines.back() != status.line))
            lines.push_back(status.line);
    });
    o.run(6);
    EXPECT_THAT(lines, testing::AnyOf(ElementsAre(0, 2), ElementsAre(2)));
}

TEST(Machine, BeginsAProgramAtAPercentSignAfterBlankLines) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("\n\n%\nG21 G90 F1200\nG1 X30\n%\nG1 X5\n", "p.ngc")); });
    o.run(5);
    EXPECT_NEAR(o.x(), 30, 0.5 / 640);
}

TEST(Machine, ExecutesAProgramWithLoopsAndSubprogramsAndThenAcceptsPlainLines) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(
            m.begin_program("o1 sub\nG1 X#1\no1 endsub\nG21 G90 F1200\n#1 = 10\no2 repeat [3]\n#1 = [#1 + 5]\no1 call "
                            "[#1]\no2 endrepeat\nG10 L2 P1 R90\nM2\n",
                            "p"));
    });
    o.at(6, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_NEAR(o.x(), 25, 0.5 / 640);
        EXPECT_FALSE(m.line("G0 X#1", 1)) << "lines from a sender have no parameters";
        EXPECT_FALSE(m.line("o1 call [1]", 2));
        EXPECT_TRUE(m.line("G90 G1 X35 F1200", 3)) << "and no turned work system";
    });
    o.run(10);
    EXPECT_NEAR(o.x(), 35, 0.5 / 640);
    EXPECT_NEAR(o.y(), 0, 0.5 / 640);
}

TEST(Machine, RefusesAProgramWithItsFirstProblemAndMovesNothing) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        const Result<void> begun = m.begin_program("G21 G90 F1200\nG1 X30\nG1 X9999\n", "p.ngc");
        ASSERT_FALSE(begun);
        EXPECT_EQ(begun.error().location.line, 3);
    });
    o.run(1);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill"));
    EXPECT_DOUBLE_EQ(o.x(), 10);
}

TEST(Machine, HoldsAProgramOnItsPathAndResumesIt) {
    Operated o(two_axes());
    double held_x = 0;
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X50\nG1 Y20\n", "p")); });
    o.at(1, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    o.at(3, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::hold);
        held_x = m.status().axes[0].commanded;
        EXPECT_FALSE(m.begin_program("G0 X0\n", "q"));
        EXPECT_TRUE(m.resume());
    });
    o.run(10);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "moving", "hold", "moving", "standstill"));
    EXPECT_GT(held_x, 20);
    EXPECT_LT(held_x, 40);
    EXPECT_NEAR(o.x(), 50, 0.5 / 640);
    EXPECT_NEAR(o.y(), 20, 0.5 / 640);
}

TEST(Machine, ExecutesTheNextLineAfterAStopDuringAPause) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.line("G1 X11 F600", 1));
        EXPECT_TRUE(m.line("M0", 2));
    });
    o.at(0.5, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::hold);
        m.stop({"anna", "", "STOP"});
    });
    o.at(0.7, [](Machine& m) {
        EXPECT_THAT(m.status().reason, HasSubstr("STOP by anna: line 2 was stopped."));
        m.reset();
    });
    o.at(0.8, [](Machine& m) { EXPECT_TRUE(m.line("G1 X12 F600", 3)); });
    o.run(1.2);
    EXPECT_NEAR(o.x(), 12, 1e-3);
}

TEST(Machine, ReportsTheLineAtWhichItWaits) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("(cold)\nM0\nG1 X11 F600\n", "cold.nc")); });
    o.at(0.5, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::hold);
        EXPECT_EQ(m.status().line, 2);
        m.stop({"anna", "", "STOP"});
    });
    o.at(0.7,
         [](Machine& m) { EXPECT_THAT(m.status().reason, HasSubstr("STOP by anna: cold.nc, line 2 was stopped.")); });
    o.run(0.8);
}

TEST(Machine, StartsTheNextLineAtTheStopPositionAfterAReset) {
    Operated o(two_axes());
    double stopped_x = 0;
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X50\nG1 Y20\n", "p")); });
    o.at(1, [](Machine& m) { m.stop(); });
    o.at(2, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        stopped_x = m.status().axes[0].commanded;
        EXPECT_FALSE(m.line("G91 G1 X-2 F600", 1));
        m.reset();
    });
    o.at(2.5, [](Machine& m) { EXPECT_TRUE(m.line("G91 G1 X-2 F600", 1)); });
    o.run(4);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "moving", "stopping", "error stop", "standstill",
                                      "moving", "standstill"));
    EXPECT_NEAR(o.x(), stopped_x - 2, 0.6 / 640);
    EXPECT_DOUBLE_EQ(o.y(), 0);
}

TEST(Machine, StopsFromAFeedHoldAndNeverRejectsAStop) {
    Operated o(two_axes());
    o.machine->stop();
    o.at(0.05, [](Machine& m) { m.reset(); });
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X50\n", "p")); });
    o.at(1, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    o.at(2, [](Machine& m) { m.stop(); });
    o.at(2.5, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        m.stop();
        m.reset();
    });
    o.at(2.6, [](Machine& m) { EXPECT_TRUE(m.line("G1 X12 F600", 1)); });
    o.run(5);
    EXPECT_NEAR(o.x(), 12, 0.5 / 640);
}

TEST(Machine, JogsWhileRenewedAndStopsWithoutRenewal) {
    Operated o(two_axes());
    for (double t = 0.1; t < 1.05; t += 0.1) o.at(t, [](Machine& m) { EXPECT_TRUE(m.manual().jog('X', 10)); });
    o.run(3);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "jogging", "standstill"));
    EXPECT_GT(o.x(), 20);
    EXPECT_LT(o.x(), 23);
    EXPECT_LT(o.stood_since, 1.35);
}

TEST(Machine, StartsLinesAtItsPositionAfterAJog) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 3, 10)); });
    o.at(2, [](Machine& m) { EXPECT_TRUE(m.line("G91 G1 X1 Y1 F600", 1)); });
    o.at(4, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('Y', 2.5, 10)); });
    o.run(6);
    EXPECT_NEAR(o.x(), 14, 1.0 / 640);
    EXPECT_NEAR(o.y(), 3.5, 1.0 / 640);
    EXPECT_NEAR(o.machine->status().axes[0].actual, 14, 1.5 / 640);
}

TEST(Machine, AppliesOverridesAndSingleBlockToAProgram) {
    Operated o(two_axes());
    int holds = 0;
    o.at(0.1, [](Machine& m) {
        m.programs().set_single_block(true);
        m.programs().set_overrides(0.5, 1);
        EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X20\nG1 X30\n", "p"));
    });
    for (double t = 0.5; t < 8; t += 0.5)
        o.at(t, [&](Machine& m) {
            if (m.state() != MachineState::hold) return;
            EXPECT_TRUE(m.resume());
            ++holds;
        });
    o.run(8);
    EXPECT_EQ(holds, 1);
    EXPECT_NEAR(o.x(), 30, 0.5 / 640);
    EXPECT_LT(o.peak_velocity, 10.1);
}

TEST(Machine, WithHomeSwitchesHasNoValidPositionUntilItIsHomed) {
    Operated o(router());
    o.at(0.1, [](Machine& m) {
        EXPECT_THAT(m.begin_program("G0 X1\n", "p").error().message, HasSubstr("axis X is not valid"));
        EXPECT_THAT(m.line("G0 X1", 1).error().message, HasSubstr("not valid"));
        EXPECT_TRUE(m.manual().home(""));
    });
    o.at(60, [](Machine& m) {
        for (const AxisStatus& axis : m.status().axes) EXPECT_TRUE(axis.position_valid) << axis.letter;
        EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X12 Y7\n", "p"));
    });
    o.run(70);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "homing", "standstill", "moving", "standstill"));
    EXPECT_NEAR(o.x(), 12, 0.5 / 640);
    const rack::RunningAxis& x = o.machine->rack().axes()[0];
    EXPECT_NEAR(x.machine->position(o.machine->now()), 12, 1.0 / 640);
}

TEST(Machine, StopsItsHoming) {
    Operated o(router());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().home("X")); });
    o.at(0.4, [](Machine& m) { m.stop(); });
    o.run(2);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "homing", "stopping", "error stop"));
    EXPECT_LT(o.stood_since, 1);
    EXPECT_FALSE(o.machine->status().axes[0].position_valid);
}

TEST(Machine, AcceptsADeclaredPositionAsValid) {
    Operated o(router());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('Y', 33)); });
    o.run(1);
    EXPECT_TRUE(o.machine->status().axes[1].position_valid);
    EXPECT_FALSE(o.machine->status().axes[0].position_valid);
    EXPECT_NEAR(o.y(), 33, 1e-9);
}

TEST(Machine, EndsWithThePositionThatWasDeclaredLast) {
    Operated o(two_axes());
    o.at(1, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('Y', 33)); });
    o.run(1);
    EXPECT_TRUE(o.machine->status().axes[1].position_valid);
    EXPECT_NEAR(o.y(), 33, 1e-9);
}

TEST(Machine, AcceptsCommandsOfManyThreads) {
    MachineSettings settings;
    auto machine = *Machine::make(two_axes(), settings);
    std::atomic<int> heard{0};
    machine->post([&] {
        EXPECT_TRUE(machine->enable(true));
        EXPECT_TRUE(machine->begin_program("G21 G90 F6000\nG1 X90\nG1 X10\n", "p"));
    });
    std::vector<std::thread> front_ends;
    for (int i = 0; i < 4; ++i)
        front_ends.emplace_back([&] {
            for (int k = 0; k < 200; ++k)
                machine->post([&] {
                    if (machine->state() == MachineState::moving) static_cast<void>(machine->hold());
                    if (machine->state() == MachineState::hold) static_cast<void>(machine->resume());
                    if (++heard == 800) machine->quit();
                });
        });
    machine->run();
    for (std::thread& one : front_ends) one.join();
    EXPECT_EQ(heard, 800);
    EXPECT_FALSE(machine->state() == MachineState::error_stop);
}

TEST(Machine, JogsAlongConsecutiveLinesAndKeepsItsModalState) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.line("G20 G91", 1)); });
    o.at(0.2, [](Machine& m) {
        EXPECT_TRUE(m.manual().jog_to({30, 20, 0, 0, 0, 0}, 20));
        EXPECT_TRUE(m.manual().jog_to({50, 20, 0, 0, 0, 0}, 20));
        EXPECT_THAT(m.line("G1 X1 F10", 2).error().message, HasSubstr("state 'jogging'"));
        EXPECT_THAT(m.manual().jog('X', 5).error().message, HasSubstr("state 'jogging'"));
    });
    o.run(6);
    EXPECT_THAT(o.states, ElementsAre("disabled", "standstill", "jogging", "standstill"));
    EXPECT_NEAR(o.x(), 50, 0.5 / 640);
    EXPECT_NEAR(o.y(), 20, 0.5 / 640);
    EXPECT_TRUE(o.machine->stream().interpreter().modes().inch &&
                o.machine->stream().interpreter().modes().incremental);
    EXPECT_EQ(o.machine->stream().moves(), 0u);
}

TEST(Machine, CancelsAJogAlongALineAndContinuesFromThere) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_to({200, 100, 0, 0, 0, 0}, 20)); });
    o.at(1, [](Machine& m) { m.cancel(); });
    o.at(2, [&](Machine& m) {
        EXPECT_GT(o.x(), 20);
        EXPECT_LT(o.x(), 40);
        EXPECT_TRUE(m.line("G91 G1 Y-1 F600", 1));
    });
    o.run(4);
    EXPECT_THAT(o.states,
                ElementsAre("disabled", "standstill", "jogging", "stopping", "standstill", "moving", "standstill"));
    EXPECT_NEAR((o.x() - 10) / 190, (o.y() + 1) / 100, 1e-3);
}

TEST(Machine, RejectsJogsBeyondItsTravelOrWithoutAFeedRate) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_THAT(m.manual().jog_to({301, 0, 0, 0, 0, 0}, 20).error().message,
                    HasSubstr("axis X goes from 0 to 300, not to 301"));
        EXPECT_THAT(m.manual().jog_to({11, 0, 1, 0, 0, 0}, 20).error().message, HasSubstr("no axis Z"));
        EXPECT_THAT(m.manual().jog_to({11, 0, 0, 0, 0, 0}, 0).error().message, HasSubstr("a jog speed of 0"));
    });
    o.run(1);
    EXPECT_DOUBLE_EQ(o.x(), 10);
}

TEST(Machine, ReportsSpindleAndCoolantWhenTheProgramHasPassedTheirWords) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X30\nM3 S900 M8\nG1 X50\nM2\n", "p")); });
    o.at(0.5, [](Machine& m) { EXPECT_EQ(m.status().spindle, control::gcode::Spindle::off); });
    o.at(2, [](Machine& m) {
        EXPECT_EQ(m.status().spindle, control::gcode::Spindle::clockwise);
        EXPECT_EQ(m.status().spindle_rpm, 900);
        EXPECT_TRUE(m.status().flood && !m.status().mist);
    });
    o.run(6);
    EXPECT_EQ(o.machine->status().spindle, control::gcode::Spindle::off);
    EXPECT_FALSE(o.machine->status().flood);
}

TEST(Machine, AcceptsPositionsOfSeveralAxesAtOnce) {
    Operated o(router());
    o.at(0.1, [](Machine& m) {
        for (const AxisStatus& axis : m.status().axes) EXPECT_TRUE(m.manual().set_position(axis.letter, 5));
    });
    o.run(0.5);
    for (const AxisStatus& axis : o.machine->status().axes) {
        EXPECT_TRUE(axis.position_valid) << axis.letter;
        EXPECT_DOUBLE_EQ(axis.commanded, 5) << axis.letter;
    }
}

TEST(Machine, ReportsThePositionsOfTheOtherAxesWhileOneIsJogged) {
    Operated o(two_axes());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('Y', 50)); });
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 20, 20)); });
    double reported = 0;
    o.at(0.5, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::jogging);
        reported = m.status().axes[1].commanded;
    });
    o.run(3);
    EXPECT_EQ(reported, 50);
    EXPECT_EQ(o.y(), 50);
}

/// Lines without motion and without duration.
class LineOfNothing : public testing::TestWithParam<const char*> {};

TEST_P(LineOfNothing, IsExecutedAloneAndBetweenOthers) {
    for (const char* profile : {"trapezoid", "jerk_limited"}) {
        SCOPED_TRACE(profile);
        rack::RackConfig config = two_axes();
        config.controller.profile = profile;
        Operated one(config);
        const auto order = [](const char* text) { return [text](Machine& m) { EXPECT_TRUE(m.line(text, 1)); }; };
        one.at(0.1, order(GetParam()));
        one.at(0.4, [](Machine& m) { EXPECT_EQ(m.state(), MachineState::standstill); });
        one.at(0.4, order("G0 X12"));
        one.at(0.4, order(GetParam()));
        one.at(0.8, order(GetParam()));
        one.at(0.8, order("G0 X13"));
        one.run(1.4);
        EXPECT_EQ(one.machine->state(), MachineState::standstill);
        EXPECT_EQ(one.x(), 13);
    }
}

INSTANTIATE_TEST_SUITE_P(Lines, LineOfNothing, testing::Values("G4 P0", "G4 P0.000001", "G0 Y0", "G90", "G1 F100", ""));

}  // namespace
}  // namespace motionrack::operate
