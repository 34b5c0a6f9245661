// A servo of an operated machine, whose card counts its encoder: its position, and the validity of the position after
// faults.
#include <gmock/gmock.h>

#include <motionrack/rack/faults.hpp>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

TEST(OperatedServoAxis, MeasuresTheFirstDistanceOfALineFromItsActualPosition) {
    Operated o(carriage());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
    o.at(0.2, [&](Machine& m) { EXPECT_TRUE(m.line("G91 G0 X5", 1)); });
    o.at(3, [&](Machine& m) {
        EXPECT_NEAR(o.x(), 105, 0.3);
        EXPECT_TRUE(m.manual().jog_by('X', 20, 50));
    });
    o.at(6, [&](Machine& m) { EXPECT_TRUE(m.line("G91 G0 X5", 2)); });
    o.run(9);
    EXPECT_NEAR(o.x(), 130, 0.3);
}

TEST(OperatedServoAxis, ExecutesALongLineInOneMove) {
    Operated o(carriage());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.line("G0 X600", 1)); });
    o.run(3);
    EXPECT_NEAR(o.x(), 600, 0.3);
    EXPECT_GT(o.peak_velocity, 480) << "of 500";
}

TEST(OperatedServoAxis, ContinuesToItsTargetAfterAFeedHold) {
    Operated o(carriage());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.line("G0 X600", 1)); });
    o.at(0.8, [](Machine& m) { EXPECT_TRUE(m.hold()); });
    o.at(3, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::hold);
        EXPECT_LT(o.x(), 500);
        EXPECT_TRUE(m.resume());
    });
    o.run(12);
    EXPECT_NEAR(o.x(), 600, 0.3);
}

TEST(OperatedServoAxis, CountsFromItsStopPosition) {
    Operated o(carriage());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.line("G0 X600", 1)); });
    o.at(0.8, [](Machine& m) { m.stop(); });
    double rest = 0;
    o.at(3, [&](Machine& m) {
        rest = o.x();
        EXPECT_LT(rest, 500);
        m.reset();
    });
    o.at(3.2, [](Machine& m) { EXPECT_TRUE(m.line("G91 G0 X5", 2)); });
    o.at(5, [&](Machine& m) {
        EXPECT_NEAR(o.x(), rest + 5, 0.5);
        EXPECT_TRUE(m.line("G90 G0 X600", 3));
    });
    o.run(14);
    EXPECT_NEAR(o.x(), 600, 0.3);
}

TEST(OperatedServoAxis, CanBeDeclaredAfterAStoppedHoming) {
    Operated o(carriage());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 0)); });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.line("G0 X200", 1)); });
    o.at(4, [](Machine& m) { EXPECT_TRUE(m.manual().home("X")); });
    o.at(4.5, [](Machine& m) { m.stop(); });
    o.at(6, [](Machine& m) {
        EXPECT_FALSE(m.status().axes[0].position_valid);
        m.reset();
    });
    o.at(6.1, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 150)); });
    o.at(6.3, [](Machine& m) {
        EXPECT_TRUE(m.status().axes[0].position_valid) << m.status().reason;
        EXPECT_TRUE(m.line("G91 G0 X5", 1));
    });
    o.run(9);
    EXPECT_NEAR(o.x(), 155, 0.3);
}

TEST(OperatedServoAxis, MovesAgainAfterItsCardWasReset) {
    for (const bool homes : {true, false}) {
        Operated o(carriage());
        const auto recover = [homes](Machine& m) {
            EXPECT_TRUE(homes ? m.manual().home("X") : m.manual().set_position('X', 200));
        };
        o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 0)); });
        o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.line("G0 X600", 1)); });
        o.at(0.6, [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "watchdog.hang", "board")); });
        o.at(5, [](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::error_stop);
            EXPECT_FALSE(m.status().axes[0].position_valid);
        });
        o.at(5.1, [](Machine& m) { m.reset(); });
        o.at(5.2, recover);
        o.at(20, [](Machine& m) {
            EXPECT_TRUE(m.status().axes[0].position_valid) << m.status().reason;
            EXPECT_TRUE(m.line("G90 G0 X300", 2));
        });
        o.run(25);
        EXPECT_NEAR(o.x(), 300, 0.3) << (homes ? "homed" : "declared") << ": " << o.machine->status().reason;
    }
}

TEST(OperatedServoAxis, LosesItsPositionWhereItsCardIsRestartedInAnErrorStop) {
    Operated o(carriage());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
    o.at(0.5, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_TRUE(m.status().axes[0].position_valid) << "it stood";
        EXPECT_TRUE(rack::inject_fault(m.rack(), "watchdog.hang", "board"));
    });
    o.run(3);
    EXPECT_FALSE(o.machine->status().axes[0].position_valid);
    ASSERT_THAT(o.machine->status().alarms, testing::SizeIs(2));
    EXPECT_EQ(o.machine->status().alarms[1].text,
              "The watchdog of card board restarted it. The position of axis X is not valid any more.");
    EXPECT_EQ(o.machine->status().alarms[1].axis, 'X');
}

/// The parameter: the reset comes in the slice of the push.
class PushInAnErrorStop : public testing::TestWithParam<bool> {};

TEST_P(PushInAnErrorStop, InvalidatesAServoThatItsFollowingErrorHasLostAlsoAfterAReset) {
    rack::RackConfig config = carriage();
    config.axes[0].following_error_alarm = 5;
    Operated o(config);
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.wires().force("estop", 0)); });
    o.at(0.4, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::error_stop);
        EXPECT_TRUE(m.status().axes[0].position_valid) << "it stood";
        EXPECT_TRUE(m.wires().force("estop", 1));
    });
    o.at(0.5, [](Machine& m) {
        EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.push=1000", "X"));  // counts of 0.01 mm
        if (GetParam()) m.reset();
    });
    o.at(0.6, [](Machine& m) {
        EXPECT_FALSE(m.status().axes[0].position_valid);
        if (!GetParam()) m.reset();
    });
    o.run(0.8);
    const Status& status = o.machine->status();
    EXPECT_EQ(status.state, MachineState::standstill) << status.reason;
    EXPECT_FALSE(status.axes[0].position_valid);
    ASSERT_THAT(status.alarms, testing::SizeIs(2));
    EXPECT_EQ(status.alarms[1].source, "following error");
    EXPECT_EQ(status.alarms[1].axis, 'X');
    EXPECT_THAT(status.alarms[1].text, testing::HasSubstr("The following error of X was"));
    EXPECT_THAT(status.alarms[1].text, testing::HasSubstr("The position of axis X is not valid any more."));
}

INSTANTIATE_TEST_SUITE_P(Resets, PushInAnErrorStop, testing::Bool());

/// The host waits for the card, then for its position, before the line fails; the machine accepts further lines
/// meanwhile.
TEST(OperatedServoAxis, IsUsableAfterLinesAndHoldsDuringAHangOfItsCard) {
    for (const double hangs_at : {0.15, 0.3, 0.33, 0.4}) {
        Operated o(carriage());
        o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 0)); });
        o.at(hangs_at, [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "watchdog.hang", "board")); });
        int taken = 0;
        for (int i = 0; i < 200; ++i)
            o.at(0.2 + 0.01 * i,
                 [&taken, i](Machine& m) { taken += m.line(i % 2 == 0 ? "G0 X5" : "G0 X0", i + 1).has_value(); });
        for (int i = 0; i < 40; ++i) o.at(0.203 + 0.05 * i, [](Machine& m) { (void)m.hold(); });
        o.at(4, [](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::error_stop);
            m.reset();
        });
        o.at(5, [](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::standstill) << "no line of before is driven";
            EXPECT_TRUE(m.manual().set_position('X', 100)) << m.status().reason;
        });
        o.at(5.2, [](Machine& m) { EXPECT_TRUE(m.line("G90 G0 X120", 1)); });
        o.run(9);
        EXPECT_GT(taken, 1);
        EXPECT_EQ(o.machine->state(), MachineState::standstill);
        EXPECT_NEAR(o.x(), 120, 0.3);
    }
}

TEST(OperatedServoAxis, HasTheDeclaredPosition) {
    Operated o(carriage());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
    double reported = 0;
    o.at(0.2, [&](Machine& m) {
        reported = m.status().axes[0].commanded;
        EXPECT_NEAR(m.status().axes[0].actual, 100, 0.011);
        EXPECT_TRUE(m.manual().jog_by('X', 20, 50));
    });
    o.run(3);
    EXPECT_NEAR(reported, 100, 0.011);
    EXPECT_NEAR(o.x(), 120, 0.3);
}

TEST(OperatedServoAxis, HasNoPositionAfterOneThatItsCardCannotCount) {
    Operated o(carriage());
    const auto set_too_far = [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 1e9)); };
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)); });
    o.at(0.2, set_too_far);
    o.at(0.4, [=](Machine& m) {
        EXPECT_FALSE(m.status().axes[0].position_valid);
        EXPECT_THAT(m.status().reason, testing::HasSubstr("Position of axis X: it is 1"));
        ASSERT_THAT(m.status().alarms, testing::SizeIs(1));
        EXPECT_EQ(m.status().alarms[0].axis, 'X');
        EXPECT_EQ(m.status().alarms[0].text,
                  "The position of axis X was not set, and is not valid any more: " + m.status().reason);
        set_too_far(m);
    });
    o.at(0.6, [](Machine& m) {
        EXPECT_THAT(m.status().alarms, testing::SizeIs(1)) << "it had none to lose";
        EXPECT_TRUE(m.manual().set_position('X', 50));
    });
    o.run(0.8);
    EXPECT_TRUE(o.machine->status().axes[0].position_valid);
    EXPECT_NEAR(o.x(), 50, 0.02);
}

TEST(OperatedServoAxis, ContinuesCountingWhenPushedBeforeItsCardKnowsThePosition) {
    Operated o(carriage());
    o.at(0.05, [](Machine& m) {
        EXPECT_TRUE(m.manual().set_position('X', 100));
        EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.push=59", "X"));  // counts of 0.01 mm
    });
    o.run(0.5);
    const AxisStatus& axis = o.machine->status().axes[0];
    EXPECT_TRUE(axis.position_valid);
    EXPECT_NEAR(axis.true_position, 0.59, 0.001);
    EXPECT_NEAR(axis.commanded, 100.59, 0.011);
}

TEST(OperatedServoAxis, HasAValidPositionAlsoIfItIsPushedAllTheTime) {
    Operated o(carriage());
    double stood = 0;
    o.each_status([&](const Status& status) {
        const double seconds = to_seconds(status.at);
        if (seconds < 0.1 || seconds > 0.25) return;
        EXPECT_TRUE(rack::inject_fault(o.machine->rack(), "motor.push=2", "X"));  // counts of 0.01 mm
    });
    o.at(0.2, [&](Machine& m) {
        stood = m.rack().axes()[0].machine->position(m.now());
        EXPECT_TRUE(m.manual().set_position('X', 100));
    });
    o.run(0.5);
    const AxisStatus& axis = o.machine->status().axes[0];
    EXPECT_GT(axis.true_position, stood + 0.1);
    EXPECT_TRUE(axis.position_valid);
    EXPECT_NEAR(axis.commanded, 100 + axis.true_position - stood, 0.5);
}

/// The watchdog does not restart a card after so short a hang, so the servo continues with its last commands.
TEST(OperatedServoAxis, StaysAtStandstillIfItsCardHangsForLessThanASecond) {
    struct Motion {
        const char* name;
        void (*begin)(Machine& m);
    };
    for (const Motion& motion : {Motion{"jog", [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 500, 20)); }},
                                 Motion{"home", [](Machine& m) { EXPECT_TRUE(m.manual().home("X")); }},
                                 Motion{"line", [](Machine& m) { EXPECT_TRUE(m.line("G0 X1500", 1)); }}}) {
        SCOPED_TRACE(motion.name);
        Operated o(carriage());
        o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 0)); });
        o.at(0.2, motion.begin);
        o.at(0.4, [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "watchdog.hang", "board")); });
        o.at(1.1, [](Machine& m) {
            EXPECT_NE(m.status().axes[0].velocity, 0) << "it cannot be stopped yet";
            m.stop();
            EXPECT_TRUE(rack::inject_fault(m.rack(), "watchdog.hang=0", "board"));
        });
        o.at(3, [](Machine& m) {
            EXPECT_EQ(m.status().axes[0].velocity, 0);
            EXPECT_EQ(m.state(), MachineState::error_stop);
            EXPECT_FALSE(m.status().axes[0].position_valid);
            m.reset();
        });
        o.at(3.1, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('X', 100)) << m.status().reason; });
        o.at(3.3, [](Machine& m) { EXPECT_TRUE(m.line("G90 G0 X120", 2)); });
        o.run(6);
        EXPECT_NEAR(o.x(), 120, 0.3);
    }
}

}  // namespace
}  // namespace motionrack::operate
