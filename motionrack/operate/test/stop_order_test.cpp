// Commands that meet in one slice: the command that was acknowledged first takes effect first.
#include <gmock/gmock.h>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::HasSubstr;

const std::string door = "[safety]\ndoor = true\n";

TEST(Disabling, PrecedesALaterStart) {
    Operated o(two_axes("[axis.X.switches]\nhome_mm = 0\n"));
    o.at(0.05, set_all_positions);
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.enable(false));
        for (const Result<void>& start :
             {m.begin_program("G21 G90 F600\nG1 X20\n", "p"), m.manual().home("X"), m.manual().jog('X', 5),
              m.manual().jog_by('X', 5, 5), m.manual().jog_to({20, 0, 0, 0, 0, 0}, 5)})
            EXPECT_THAT(refusal_of(start), HasSubstr("axis X is disabled"));
        EXPECT_FALSE(m.line("G1 X20 F600", 1));
    });
    o.run(3);
    EXPECT_EQ(o.x(), 0) << "as at first";
    EXPECT_EQ(o.machine->state(), MachineState::disabled);
}

TEST(Reset, PrecedesALaterStart) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        m.reset();
        EXPECT_THAT(refusal_of(m.begin_program("G21 G90 F600\nG1 X20\n", "p")), HasSubstr("a reset is being"));
        EXPECT_FALSE(m.line("G1 X20 F600", 1));
    });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.line("G1 X12 F600", 1)); });
    o.run(1);
    EXPECT_EQ(o.x(), 12);
}

TEST(Cancelling, AtStandstillDoesNotEndLaterCommands) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        m.cancel();
        EXPECT_TRUE(m.manual().jog_by('X', 5, 20));
    });
    o.run(1);
    EXPECT_NEAR(o.x(), 15, 1e-9);
}

TEST(Stop, DiscardsTheOffsetsOfLinesThatWereOnlyRead) {
    const std::string program = "G21 G90\nG0 X0\nG1 X20 F600\nG10 L2 P1 X20\nM2\n";
    Operated o(two_axes());
    const auto offset = [&] { return o.machine->stream().fresh_settings().work_offsets[0][0]; };
    o.at(0.1, [&](Machine& m) { EXPECT_TRUE(m.begin_program(program, "shift.ngc")); });
    o.at(1.5, [](Machine& m) { m.stop({"anna", "", "STOP"}); });
    o.at(2, [](Machine& m) { m.reset(); });
    o.at(2.5, [&](Machine& m) {
        EXPECT_GT(o.x(), 0);
        EXPECT_LT(o.x(), 20);
        EXPECT_EQ(offset(), 0);
        EXPECT_TRUE(m.begin_program(program, "shift.ngc"));
    });
    o.run(7);
    EXPECT_NEAR(o.x(), 20, 1e-3);
    EXPECT_EQ(offset(), 20) << "all of it was executed";
}

TEST(Cancelling, DiscardsTheOffsetsOfLinesThatWereOnlyRead) {
    Operated o(two_axes());
    const control::gcode::WorkFrame earlier = o.machine->stream().interpreter().frame();
    o.at(0.1, [](Machine& m) {
        int number = 0;
        for (const char* line : {"G10 L2 P1 X1", "G1 X50 F600", "G10 L20 P1 X0", "G92 X5", "G28.1", "G1 X10", "G30.1"})
            EXPECT_TRUE(m.line(line, ++number)) << line;
    });
    o.at(1, [](Machine& m) { m.cancel(); });
    o.run(2);
    const control::gcode::WorkFrame& frame = o.machine->stream().interpreter().frame();
    EXPECT_EQ(frame.work[0], (control::Point{1})) << "executed before the motion";
    EXPECT_EQ(frame.g92, control::Point{});
    EXPECT_EQ(frame.g28, earlier.g28);
    EXPECT_EQ(frame.g30, earlier.g30);
    EXPECT_EQ(frame.offset[0], 1);
}

class HoldBeforeTheFirstLine : public testing::TestWithParam<bool> {
  protected:
    static rack::RackConfig config() {
        rack::RackConfig out = two_axes(door);
        out.controller.profile = GetParam() ? "jerk_limited" : "trapezoid";
        return out;
    }
    /// Holds a program by `hold` in the slice of its start, and resumes it 0.9 s later, after `before_resume`.
    static void expect_held_until_resumed(void (*hold)(Machine& m), void (*before_resume)(Machine& m)) {
        Operated o(config());
        o.at(0.05, set_all_positions);
        o.at(0.1, [=](Machine& m) {
            EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X20\nM2\n", "p"));
            hold(m);
        });
        o.at(1, [=](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::hold);
            EXPECT_EQ(m.status().axes[0].commanded, 10);
            before_resume(m);
            EXPECT_TRUE(m.resume());
        });
        o.run(3);
        EXPECT_NEAR(o.x(), 20, 1e-3);
    }
};

TEST_P(HoldBeforeTheFirstLine, HoldsTheProgram) {
    expect_held_until_resumed([](Machine& m) { EXPECT_TRUE(m.hold()); }, [](Machine&) {});
}

TEST_P(HoldBeforeTheFirstLine, IsRequestedByTheDoor) {
    expect_held_until_resumed([](Machine& m) { EXPECT_TRUE(m.wires().force("door", 0)); },
                              [](Machine& m) { EXPECT_TRUE(m.wires().force("door", 1)); });
}

TEST_P(HoldBeforeTheFirstLine, IsRequestedByTheLossOfTheJournal) {
    Operated o(config());
    o.at(0.05, set_all_positions);
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X20\nM2\n", "p"));
        m.forbid_starts("journal", "The disk is full.");
    });
    o.run(1);
    EXPECT_EQ(o.x(), 10);
}

INSTANTIATE_TEST_SUITE_P(Profiles, HoldBeforeTheFirstLine, testing::Bool(),
                         [](const auto& each) { return each.param ? "JerkLimited" : "Trapezoid"; });

/// A probing move of 100 mm that touches nothing.
class ProbingMove : public testing::TestWithParam<bool> {};

TEST_P(ProbingMove, EndsWhenTheDoorOpensOrTheJournalIsLost) {
    rack::RackConfig config = *rack::read_rack_file((source_root / "examples/16_probe/machine.toml").string()).config;
    config.safety.door = true;
    Operated o(config);
    double stood = 0;
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G91\nG38.3 X100 F600\nG1 X1\nM2\n", "p")); });
    o.at(1, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::moving);
        EXPECT_GT(m.status().axes[0].velocity, 5);
        if (GetParam())
            EXPECT_TRUE(m.wires().force("door", 0));
        else
            m.forbid_starts("journal", "The disk is full.");
    });
    o.at(1.2, [&](Machine& m) {
        EXPECT_EQ(m.status().axes[0].velocity, 0);
        stood = m.status().axes[0].commanded;
    });
    o.run(2);
    EXPECT_EQ(o.x(), stood);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
    ASSERT_FALSE(o.machine->status().alarms.empty());
    EXPECT_TRUE(o.machine->status().axes[0].position_valid);
}

INSTANTIATE_TEST_SUITE_P(By, ProbingMove, testing::Bool(),
                         [](const auto& each) { return each.param ? "TheDoor" : "TheRecord"; });

/// STOP at full velocity, then another cause in the ramp or at standstill.
class AnotherCause : public testing::TestWithParam<double> {};

TEST_P(AnotherCause, AfterAStopCommandHasItsOwnAlarm) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F6000\nG1 X200\nM2\n", "p")); });
    o.at(1, [](Machine& m) { m.stop({"anna", "", "STOP"}); });
    o.at(1 + GetParam(), [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
    o.at(2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        ASSERT_EQ(m.status().alarms.size(), 1U);
        EXPECT_EQ(m.status().alarms[0].source, "emergency stop");
        EXPECT_EQ(m.status().axes[0].position_valid, GetParam() > 0.1);
        EXPECT_FALSE(m.rack().stop_latch().is_ordered());
        m.reset();
    });
    o.at(2.1, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << "it is still pressed";
        EXPECT_TRUE(m.wires().force("estop", 1));
        m.reset();
    });
    o.run(2.2);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
}

INSTANTIATE_TEST_SUITE_P(After, AnotherCause, testing::Values(0.004, 0.5),
                         [](const auto& each) { return each.param < 0.1 ? "InTheRamp" : "AtStandstill"; });

TEST(DeclaredPositions, AreAllExecutedHoweverFastTheyArrive) {
    Operated o(carriage());
    double last = 0;
    o.each_status([&](const Status& status) {
        if (to_seconds(status.at) < 0.1 || to_seconds(status.at) > 0.4) return;
        const double position = 10 + 100 * to_seconds(status.at);
        if (o.machine->manual().set_position('X', position)) last = position;
    });
    o.run(1.5);
    EXPECT_GT(last, 40);
    EXPECT_NEAR(o.x(), last, 0.05);
}

}  // namespace
}  // namespace motionrack::operate
