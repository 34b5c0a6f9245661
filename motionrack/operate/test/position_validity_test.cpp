// Positions of a jogged machine after faults: the same rules as in a program run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/faults.hpp>
#include <motionrack/rack/homing.hpp>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::HasSubstr;

struct BrokenJog {
    const char* name;
    bool servo;
    double speed;       ///< mm/s
    const char* fault;  ///< a wire, or a fault of X
    bool wire;
    bool position_valid;
    const char* alarm;  ///< part of the alarm text; empty: no alarm
};

std::ostream& operator<<(std::ostream& out, const BrokenJog& one) {
    return out << one.name;
}

constexpr const char* lost = "The position of axis X is not valid any more.";
constexpr const char* behind = "The following error of X was";

constexpr BrokenJog broken_jogs[] = {
    {"estop_slow", false, 20, "estop", true, false, "position of X is not valid any more"},
    {"estop_fast", false, 100, "estop", true, false, "position of X is not valid any more"},
    {"estop_of_the_card_alone", false, 100, "m.emgn", true, false, "Its position is not valid"},
    {"stall", false, 50, "motor.stall", false, false, behind},
    {"lost_steps", false, 50, "motor.lose_steps=64", false, false, lost},
    {"push", false, 50, "motor.push=64", false, false, lost},
    {"encoder_dead", false, 50, "encoder.broken_a", false, false, behind},
    {"encoder_swapped", false, 50, "encoder.swapped", false, false, behind},
    {"encoder_input_held", false, 50, "m.xeca", true, false, behind},
    {"nothing", false, 50, "encoder.broken_a=0", false, true, ""},
    {"servo_stall", true, 100, "motor.stall", false, false, "does not follow"},
    {"servo_encoder_dead", true, 100, "encoder.broken_a", false, false, "does not follow"},
    {"servo_encoder_swapped", true, 100, "encoder.swapped", false, false, behind},
    {"servo_without_voltage", true, 100, "X.drive", true, false, "does not follow"},
    {"servo_estop", true, 100, "estop", true, true, "emergency stop"},
    {"servo_pushed", true, 100, "motor.push=1000", false, true, ""},
};

class JogThatBreaks : public testing::TestWithParam<BrokenJog> {};

TEST_P(JogThatBreaks, KeepsOrInvalidatesThePositionAsAProgramDoesAndAlarms) {
    const BrokenJog& one = GetParam();
    Operated o(one.servo ? carriage() : two_axes());
    o.at(0.05, [&](Machine& m) {
        for (const AxisStatus& axis : m.status().axes)
            if (!axis.position_valid) {
                EXPECT_TRUE(m.manual().set_position(axis.letter, axis.commanded));
            }
    });
    for (int n = 2; n < 40; ++n) {
        o.at(0.1 * n, [&, n](Machine& m) { static_cast<void>(m.manual().jog('X', one.speed, {"a", n, n > 2})); });
        if (n == 10)
            o.at(0.1 * n, [&](Machine& m) {
                EXPECT_EQ(m.state(), MachineState::jogging);
                EXPECT_TRUE(m.status().axes[0].position_valid);
                const Result<void> broken =
                    one.wire ? m.wires().force(one.fault, 0) : rack::inject_fault(m.rack(), one.fault, "X");
                EXPECT_TRUE(broken) << broken.error().message;
            });
    }
    o.run(6);
    const Status& status = o.machine->status();
    EXPECT_EQ(status.axes[0].position_valid, one.position_valid);
    std::vector<std::string> alarms;
    for (const Alarm& alarm : status.alarms) alarms.push_back(alarm.text);
    if (*one.alarm == '\0') {
        EXPECT_THAT(alarms, testing::IsEmpty());
    } else {
        EXPECT_THAT(alarms, testing::ElementsAre(HasSubstr(one.alarm))) << "one cause, one alarm";
    }
}

INSTANTIATE_TEST_SUITE_P(Faults, JogThatBreaks, testing::ValuesIn(broken_jogs),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(Machine, HasNoAlarmWhereAJogFailsThatHadNoPositionToLose) {
    Operated o(carriage());
    for (int n = 1; n < 40; ++n)
        o.at(0.1 * n, [n](Machine& m) { static_cast<void>(m.manual().jog('X', 100, {"a", n, n > 1})); });
    o.at(1.05, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::jogging);
        EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.stall", "X"));
    });
    o.at(4, [](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill);
        EXPECT_THAT(m.status().reason, HasSubstr("Axis X does not follow"));
        EXPECT_THAT(m.status().alarms, testing::IsEmpty());
    });
    o.run(4.1);
}

TEST(Machine, HasAValidPositionOnceOneIsDeclaredAfterLostSteps) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 20, 50)); });
    o.at(0.3, [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.lose_steps=64", "X")); });
    o.at(2, [](Machine& m) {
        EXPECT_FALSE(m.status().axes[0].position_valid);
        EXPECT_THAT(m.line("G1 X1 F600", 1).error().message, HasSubstr("not valid"));
        EXPECT_TRUE(m.manual().set_position('X', 12));
    });
    o.at(2.5, [](Machine& m) { EXPECT_TRUE(m.line("G1 X15 F600", 1)); });
    o.run(4);
    EXPECT_TRUE(o.machine->status().axes[0].position_valid);
    EXPECT_NEAR(o.x(), 15, 1e-3);
    EXPECT_EQ(o.machine->status().alarms.size(), 1u) << "what was lost before it was declared is told once";
}

TEST(Machine, InvalidatesAnAxisWhosePulsesEndWithoutARampAtALimitSwitch) {
    Operated o(two_axes("[controller]\nprofile = \"jerk_limited\"\n[axis.X.switches]\nlimit_plus_mm = 302\n"));
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90\nG1 X200 F6000\nM2\n", "p")); });
    o.at(1, [](Machine& m) { EXPECT_TRUE(m.wires().force("X.limit_plus", 0)); });
    o.run(2);
    const Status& status = o.machine->status();
    EXPECT_EQ(status.state, MachineState::error_stop);
    EXPECT_FALSE(status.axes[0].position_valid);
    EXPECT_TRUE(status.axes[1].position_valid) << "it did not move";
    ASSERT_THAT(status.alarms, testing::SizeIs(1)) << "one cause, one alarm";
    EXPECT_THAT(status.alarms[0].text, HasSubstr("The position of X is not valid any more"));
}

TEST(Machine, InvalidatesAnAxisThatWasResetWhileItStillStopped) {
    Operated o(two_axes());
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.stall", "X")); });
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90\nG1 X200 F6000\nM2\n", "p")); });
    bool reset = false;
    o.each_status([&](const Status& status) {
        if (status.state == MachineState::stopping && !std::exchange(reset, true)) o.machine->reset();
    });
    o.run(2);
    const Status& status = o.machine->status();
    ASSERT_TRUE(reset);
    EXPECT_EQ(status.state, MachineState::standstill);
    EXPECT_FALSE(status.axes[0].position_valid) << "its motor stood";
    ASSERT_THAT(status.alarms, testing::SizeIs(1)) << "one cause, one alarm";
    EXPECT_THAT(status.alarms[0].text, HasSubstr("The following error of X was"));
}

TEST(Machine, MovesNoAxisBetweenTheDeclarationOfAPositionAndItsEffect) {
    Operated o(two_axes());
    const auto refused = [](const Result<void>& order) {
        EXPECT_THAT(order ? "taken" : order.error().message, HasSubstr("positions of axes are being set"));
    };
    o.at(0.1, [&](Machine& m) {
        EXPECT_TRUE(m.manual().set_position('X', 5));
        EXPECT_TRUE(m.manual().set_position('Y', 7)) << "several may be declared together";
        refused(m.manual().jog_by('X', 10, 20));
        refused(m.manual().jog('X', 20));
        refused(m.manual().home("X"));
    });
    o.at(0.2, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('X', 10, 20)); });
    o.run(2);
    EXPECT_NEAR(o.x(), 15, 1e-3);
    EXPECT_NEAR(o.y(), 7, 1e-3);
}

TEST(Machine, InvalidatesAnAxisPushedBetweenTheDeclarationOfItsPositionAndItsEffect) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) {
        EXPECT_TRUE(m.manual().set_position('X', 5));
        EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.push=640", "X"));
    });
    o.at(0.5, [](Machine& m) {
        EXPECT_FALSE(m.status().axes[0].position_valid) << "it was declared where it stood before";
        ASSERT_THAT(m.status().alarms, testing::SizeIs(1));
        EXPECT_THAT(m.status().alarms[0].text, HasSubstr(lost));
        EXPECT_TRUE(m.manual().set_position('X', 6));
    });
    o.run(1);
    EXPECT_TRUE(o.machine->status().axes[0].position_valid) << "it is declared where it stands now";
}

/// Returns true if the axes' homing states contain `text`.
bool is_homing(const Status& status, const char* text) {
    return rack::homing_states_text(status.homing).find(text) != std::string::npos;
}

/// Homes the router; when A is homed, long before the other axes, calls `then` and pushes A.
void push_what_is_home(Operated& o, void (*then)(Machine&)) {
    bool pushed = false;
    o.each_status([&o, then, pushed](const Status& status) mutable {
        if (!is_homing(status, "A HOMED") || std::exchange(pushed, true)) return;
        EXPECT_EQ(status.state, MachineState::homing);
        then(*o.machine);
        EXPECT_TRUE(rack::inject_fault(o.machine->rack(), "motor.push=64", "A"));
    });
    o.at(0.05, [](Machine& m) { EXPECT_TRUE(m.manual().set_position('A', 0)); });
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().home({})); });
    o.run(40);
    const Status& status = o.machine->status();
    ASSERT_EQ(status.axes[3].letter, 'A');
    EXPECT_FALSE(status.axes[3].position_valid);
    std::vector<std::string> alarms;
    for (const Alarm& alarm : status.alarms) alarms.push_back(alarm.text);
    EXPECT_THAT(alarms, testing::ElementsAre(HasSubstr("The position of axis A is not valid any more.")));
}

TEST(Machine, InvalidatesAnAxisPushedWhileOthersAreStillHoming) {
    Operated o(router());
    push_what_is_home(o, [](Machine&) {});
    EXPECT_EQ(o.machine->state(), MachineState::standstill) << o.machine->status().reason;
    for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(o.machine->status().axes[i].position_valid);
}

TEST(Machine, InvalidatesAnAxisPushedWhileTheHomingOfOthersIsStopped) {
    Operated o(router());
    push_what_is_home(o, [](Machine& m) { m.stop({"anna", "", "STOP"}); });
    EXPECT_EQ(o.machine->state(), MachineState::error_stop);
}

TEST(FollowingError, ThatGrowsSlowlyIsAWarningUntilItIsAnAlarm) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.begin_program("G21 G90\nG1 X60 F300\nM2\n", "p")); });
    o.at(0.5, [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "encoder.broken_a", "X")); });
    o.at(0.65, [](Machine& m) {
        ASSERT_THAT(m.status().alarms, testing::SizeIs(1)) << "above 0.5 mm";
        EXPECT_EQ(m.status().alarms[0].source, "following error");
        EXPECT_THAT(m.status().alarms[0].text, HasSubstr("above the warning limit of 0.5 mm"));
        EXPECT_EQ(m.state(), MachineState::moving);
    });
    o.run(2);
    const Status& status = o.machine->status();
    ASSERT_THAT(status.alarms, testing::SizeIs(1)) << "above 1 mm the alarm takes its place";
    EXPECT_THAT(status.alarms[0].text, HasSubstr("above its limit of 1 mm"));
    EXPECT_EQ(status.state, MachineState::error_stop);
    EXPECT_FALSE(status.axes[0].position_valid);
}

/// X with its index at 0 mm, 2 mm from its switch.
const char* const with_index =
    "[axis.X.switches]\nlimit_minus_mm = -8\nlimit_plus_mm = 302\nhome_mm = 2\n[axis.X.homing]\nmethod = 4\n"
    "home_offset_mm = 0\n";

TEST(SecondIndex, IsReportedFromTheSecondHomingOn) {
    Operated o(two_axes(with_index));
    bool disturbs = false, at_switch = false, pulsed = false;
    o.each_status([&](const Status& status) {
        const auto is_in = [&](const char* state) { return is_homing(status, state); };
        at_switch = at_switch || (disturbs && is_in("SLOW_WAIT"));
        if (!at_switch || pulsed || !is_in("INDEX_WAIT") || status.axes[0].true_position > 1.6) return;
        pulsed = true;
        EXPECT_TRUE(o.machine->wires().force("m.xin2", 1));
    });
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.manual().home("X")); });
    o.at(20, [&](Machine& m) {
        EXPECT_EQ(m.state(), MachineState::standstill) << m.status().reason;
        EXPECT_TRUE(m.status().axes[0].position_valid);
        disturbs = true;
        EXPECT_TRUE(m.manual().home("X"));
    });
    o.run(40);
    EXPECT_TRUE(pulsed);
    const Status& status = o.machine->status();
    EXPECT_FALSE(status.axes[0].position_valid);
    ASSERT_THAT(status.alarms, testing::SizeIs(1));
    EXPECT_THAT(status.alarms[0].text, HasSubstr("behind the switch; it must be 2.0000 mm behind it"));
}

}  // namespace
}  // namespace motionrack::operate
