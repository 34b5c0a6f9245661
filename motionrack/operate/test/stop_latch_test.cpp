// The stop latch of an operated machine: states x sources, refusals, and a reset without motion.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::HasSubstr;

const std::string switches =
    "[axis.X.switches]\nlimit_minus_mm = -5\nlimit_plus_mm = 305\nhome_mm = 0\n"
    "[axis.Y.switches]\nlimit_minus_mm = -5\nlimit_plus_mm = 305\n";

/// Presses the emergency stop at 2 s and releases it at 2.2 s.
void press_and_release(Operated& o) {
    o.at(2, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
    o.at(2.2, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 1)); });
}

/// Expects an error stop without motion: a resume and a line have no effect, a reset moves nothing, then a new line
/// moves.
void expect_latched_until_reset(Operated& o, double x) {
    o.at(3, [x](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << name_of(m.state());
        EXPECT_NEAR(m.status().axes[0].commanded, x, 0.01);
        ASSERT_EQ(m.status().alarms.size(), 1u);
        EXPECT_EQ(m.status().alarms[0].source, "emergency stop");
        EXPECT_TRUE(m.status().axes[0].position_valid);
        EXPECT_FALSE(m.resume());
        EXPECT_THAT(m.line("G1 X30 F600", 1).error().message, HasSubstr("The emergency stop was pressed"));
        EXPECT_FALSE(m.manual().jog('X', 5));
        EXPECT_FALSE(m.manual().home(""));
    });
    o.at(4, [](Machine& m) { m.reset(); });
    o.at(5, [x](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_NEAR(m.status().axes[0].commanded, x, 0.01) << "a reset moves nothing";
        EXPECT_FALSE(m.resume()) << "what was under way is forgotten";
        EXPECT_TRUE(m.line("G21 G90 G1 X30 F1200", 1));
    });
    o.run(9);
    EXPECT_NEAR(o.x(), 30, 0.01);
}

TEST(StopLatch, StopsAMachineDuringADwell) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X20\nG4 P5\nG1 X80\n", "p")); });
    press_and_release(o);
    expect_latched_until_reset(o, 20);
}

TEST(StopLatch, StopsAMachineDuringAFeedHold) {
    Operated o(two_axes());
    double held = 0;
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X80\n", "p")); });
    o.at(0.6, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    o.at(1.5, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::hold);
        held = m.status().axes[0].commanded;
    });
    press_and_release(o);
    o.at(2.3, [](Machine& m) { EXPECT_FALSE(m.resume()); });
    o.at(3, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_FALSE(m.resume());
        m.reset();
    });
    o.run(6);
    EXPECT_GT(held, 15);
    EXPECT_EQ(o.x(), held);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
}

TEST(StopLatch, StopsAMachineWaitingAtM0) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X20\nM0\nG1 X80\n", "p")); });
    o.at(1.5, [](Machine& m) { EXPECT_EQ(m.state(), MachineState::hold); });
    press_and_release(o);
    expect_latched_until_reset(o, 20);
}

TEST(StopLatch, StopsAMachineInSingleBlock) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        m.programs().set_single_block(true);
        EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X20\nG1 X80\n", "p"));
    });
    o.at(1.5, [](Machine& m) { EXPECT_EQ(m.state(), MachineState::hold); });
    press_and_release(o);
    o.at(2.3, [](Machine& m) { m.programs().set_single_block(false); });
    expect_latched_until_reset(o, 20);
}

TEST(StopLatch, StopsAMachineWaitingForTheNextLine) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.line("G21 G90 G1 X20 F1200", 1)); });
    press_and_release(o);
    expect_latched_until_reset(o, 20);
}

TEST(StopLatch, IsSetByTheStopCommand) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90 F1200\nG1 X20\nG4 P5\nG1 X80\n", "p")); });
    o.at(2, [](Machine& m) { m.stop(); });
    o.at(3, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_THAT(m.status().reason, HasSubstr("Stopped on request at 2.0"));
        EXPECT_TRUE(m.status().alarms.empty()) << "who asked for it needs no alarm";
        EXPECT_THAT(m.line("G1 X30 F600", 1).error().message, HasSubstr("Reset"));
        m.reset();
    });
    o.at(4, [](Machine& m) { EXPECT_TRUE(m.line("G21 G90 G1 X30 F1200", 1)); });
    o.run(7);
    EXPECT_NEAR(o.x(), 30, 0.01);
}

/// Resets in motion, with another stop before standstill.
void expect_reset_does_not_release(const std::function<void(Machine&)>& later_stop) {
    Operated o(two_axes());
    double stood = 0;
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90\nG0 X200\n", "p")); });
    o.at(1, [](Machine& m) { m.reset(); });
    o.at(1.01, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::stopping);
        later_stop(m);
    });
    o.at(3, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop) << "nobody has reset since";
        EXPECT_FALSE(m.line("G1 X30 F600", 1));
        EXPECT_FALSE(m.manual().jog('X', 5));
        stood = m.status().axes[0].commanded;
        m.reset();
    });
    o.run(4);
    EXPECT_EQ(o.machine->state(), MachineState::standstill) << o.machine->status().reason;
    EXPECT_EQ(o.x(), stood);
}

TEST(StopLatch, IsNotReleasedByAResetBeforeAStopCommand) {
    expect_reset_does_not_release([](Machine& m) { m.stop(); });
}

TEST(StopLatch, IsNotReleasedByAResetBeforeALimitSwitch) {
    expect_reset_does_not_release([](Machine& m) { EXPECT_TRUE(m.wires().force("m.xlmtp", 0)); });
}

TEST(StopLatch, IsNotReleasedByAResetBeforeAShortPressOfTheButton) {
    expect_reset_does_not_release([](Machine& m) {
        EXPECT_TRUE(m.wires().force("estop", 0));
        EXPECT_TRUE(m.wires().force("estop", 1));
    });
}

TEST(StopLatch, IsReleasedByAResetRequestedDuringDeceleration) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90\nG0 X200\n", "p")); });
    o.at(1, [](Machine& m) { m.stop(); });
    o.at(1.01, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::stopping);
        m.reset();
    });
    o.run(3);
    EXPECT_EQ(o.machine->state(), MachineState::standstill) << o.machine->status().reason;
}

TEST(StopLatch, StaysSetWhileItsCauseIsActive) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.wires().force("m.xalarm", 0)); });
    o.at(0.5, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        m.reset();
    });
    o.at(1, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_THAT(m.status().reason, HasSubstr("the drive of X still reports an alarm"));
        EXPECT_TRUE(m.wires().force("m.xalarm", 1));
        m.reset();
    });
    o.run(2);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
    EXPECT_EQ(o.machine->status().alarms.size(), 1u) << "one alarm a cause";
}

TEST(StopLatch, EndsAJogThatIsRenewedThroughAShortPressOfTheButton) {
    Operated o(two_axes());
    for (int i = 0; i < 30; ++i) {
        if (i == 10) {
            o.at(1.05, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
            o.at(1.08, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 1)); });
        }
        o.at(0.1 + 0.1 * i, [](Machine& m) { (void)m.manual().jog('X', 20); });
    }
    o.run(4);
    EXPECT_EQ(o.machine->state(), MachineState::error_stop);
    EXPECT_LT(o.stood_since, 1.06);
}

TEST(StopLatch, AllowsJoggingOffALimitSwitchAfterAReset) {
    Operated o(two_axes("[axis.X.switches]\nlimit_plus_mm = 12\n"));
    for (double t = 0.1; t < 1; t += 0.1) o.at(t, [](Machine& m) { (void)m.manual().jog('X', 5); });
    o.at(2, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_TRUE(m.status().axes[0].position_valid) << "it has decelerated";
        m.reset();
    });
    o.at(2.5, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', -4, 5)); });
    o.run(5);
    EXPECT_EQ(o.machine->state(), MachineState::standstill);
    EXPECT_LT(o.x(), 9);
}

TEST(StopLatch, StopsAllThatIsJoggedWhereOneAxisReachesItsLimitSwitch) {
    for (const bool by_distance : {true, false}) {
        Operated o(two_axes("[axis.Y.switches]\nlimit_plus_mm = 5\n"));
        if (by_distance) o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 200, 20)); });
        for (double t = 0.1; t < 2; t += 0.1)
            o.at(t, [by_distance](Machine& m) {
                if (!by_distance) (void)m.manual().jog('X', 20);
                (void)m.manual().jog('Y', 20);
            });
        o.run(3);
        EXPECT_EQ(o.machine->state(), MachineState::error_stop);
        EXPECT_NEAR(o.x(), o.y() + 10, 0.6) << "they began together, and both braked at the switch";
    }
}

TEST(StopLatch, StopsTheFourthAxisOfAPathWhereAnotherReachesItsLimitSwitch) {
    for (const char* profile : {"trapezoid", "jerk_limited"}) {
        rack::RackConfig config = router();
        config.controller.profile = profile;
        Operated o(config);
        o.at(0.05, [](Machine& m) {
            for (const AxisStatus& axis : m.status().axes)
                EXPECT_TRUE(m.manual().set_position(axis.letter, axis.true_position));
        });
        o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_to({80, 80, 20, 20}, 50)); });
        o.at(0.5, [](Machine& m) {
            EXPECT_GT(m.status().axes[3].velocity, 2);
            EXPECT_TRUE(m.wires().force("Z.limit_minus", 0));
        });
        std::int64_t stood = 0;
        o.each_status([&](const Status& status) {
            if (status.at <= milliseconds(500) || status.axes[3].velocity != 0) return;
            if (stood == 0) stood = status.axes[3].pulses;
            EXPECT_EQ(status.axes[3].pulses, stood) << profile << ": it moved again, at " << to_seconds(status.at);
        });
        o.at(0.9, [&](Machine& m) {
            EXPECT_EQ(m.status().axes[3].velocity, 0) << profile;
            EXPECT_EQ(m.state(), MachineState::error_stop) << profile;
        });
        o.run(1.2);
    }
}

/// The chip ends the pulses of a path at the end of its segment where one of its axes has reached a switch. No edge
/// sets the latch, because the switch was active before.
TEST(StopByACard, InvalidatesAnAxisWhosePulsesEndWithoutARamp) {
    for (const char* profile : {"trapezoid", "jerk_limited"}) {
        rack::RackConfig config = router();
        config.controller.profile = profile;
        Operated o(config);
        o.at(0.05, [](Machine& m) {
            for (const AxisStatus& axis : m.status().axes)
                EXPECT_TRUE(m.manual().set_position(axis.letter, axis.true_position));
        });
        o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.wires().force("X.limit_minus", 0)); });
        o.at(0.15, [](Machine& m) { m.reset(); });
        o.at(0.2, [](Machine& m) {
            const std::vector<AxisStatus>& axes = m.status().axes;
            const double x = axes[0].commanded, y = axes[1].commanded;
            EXPECT_TRUE(m.begin_program(fmt::format("G21 G90 G17 F3000\nG3 X{} Y{} J20\nM2\n", x, y + 40), "p"));
        });
        o.at(2, [&](Machine& m) {
            ASSERT_EQ(m.state(), MachineState::error_stop) << profile;
            EXPECT_TRUE(m.status().axes[0].position_valid) << profile << ": it was slow where it turned back";
            EXPECT_FALSE(m.status().axes[1].position_valid) << profile;
            EXPECT_NE(m.status().reason.find("The position of Y is not valid any more: steps may have been lost"),
                      std::string::npos)
                << m.status().reason;
        });
        o.run(2.1);
    }
}

TEST(StopLatch, InvalidatesPositionsAtOnceWhereTheEmergencyStopEndsThePulsesOfAHold) {
    Operated o(router());
    o.at(0.05, [](Machine& m) {
        for (const AxisStatus& axis : m.status().axes)
            EXPECT_TRUE(m.manual().set_position(axis.letter, axis.true_position));
    });
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90\nG0 X200\nM2\n", "p")); });
    o.at(0.5, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    o.at(0.52, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
    o.at(0.545, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_FALSE(m.status().axes[0].position_valid);
    });
    o.run(1);
}

TEST(StopLatch, IsNotSetByTheSwitchesOfAHoming) {
    Operated o(two_axes(switches));
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().home("X")); });
    o.run(20);
    EXPECT_EQ(o.machine->state(), MachineState::standstill) << o.machine->status().reason;
    EXPECT_TRUE(o.machine->status().axes[0].position_valid);
}

TEST(StopLatch, InvalidatesAPositionThatALimitSwitchStopsAtOnceWithTheErrorStop) {
    int slipped = 0;
    for (int k = 0; k < 60; ++k) {
        const double at = 1.2 + 0.0023 * k, velocity = 5 + 0.1 * k;
        SCOPED_TRACE(testing::Message() << velocity << " mm/s, at " << at << " s");
        Operated o(two_axes("[controller]\nprofile = \"jerk_limited\"\n[axis.X.switches]\nlimit_plus_mm = 305\n"));
        std::optional<bool> valid;
        o.each_status([&](const Status& status) {
            if (!valid && status.state == MachineState::error_stop) valid = status.axes[0].position_valid;
        });
        o.at(0.1, [&](Machine& m) { EXPECT_TRUE(m.manual().jog_to({100, 30}, velocity)); });
        o.at(at, [](Machine& m) { EXPECT_TRUE(m.wires().force("X.limit_plus", 0)); });
        o.run(at + 0.3);
        ASSERT_TRUE(valid);
        const AxisStatus& x = o.machine->status().axes[0];
        if (std::fabs(x.commanded - x.true_position) < 0.01) continue;
        ++slipped;
        EXPECT_FALSE(*valid) << "its motor slipped to " << x.true_position << " from " << x.commanded;
    }
    EXPECT_GT(slipped, 0);
}

}  // namespace
}  // namespace motionrack::operate
