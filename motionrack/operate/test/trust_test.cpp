// What happens to the positions of a machine that is jogged when something breaks: as in a program that is run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/rack/faults.hpp>
#include <tests/source_root.hpp>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

using testing::Contains;
using testing::HasSubstr;

rack::RackConfig carriage() {
    return *rack::read_rack_file((source_root / "examples/11_carriage/machine.toml").string()).config;
}

struct BrokenJog {
    const char* name;
    bool servo;
    double speed;       ///< mm/s
    const char* fault;  ///< a wire, or X's fault
    bool wire;
    bool trusted;
    const char* alarm;  ///< words of one; empty: there is none
};

std::ostream& operator<<(std::ostream& out, const BrokenJog& one) {
    return out << one.name;
}

constexpr const char* lost = "The position of axis X is not trusted any more.";
constexpr const char* behind = "The following error of X was";

constexpr BrokenJog broken_jogs[] = {
    {"estop_slow", false, 20, "estop", true, false, "position of X is not trusted any more"},
    {"estop_fast", false, 100, "estop", true, false, "position of X is not trusted any more"},
    {"estop_of_the_card_alone", false, 100, "m.emgn", true, false, "Its position is not trusted"},
    {"stall", false, 50, "motor.stall", false, false, behind},
    {"lost_steps", false, 50, "motor.lose_steps=64", false, false, lost},
    {"push", false, 50, "motor.push=64", false, false, lost},
    {"encoder_dead", false, 50, "encoder.broken_a", false, false, behind},
    {"encoder_swapped", false, 50, "encoder.swapped", false, false, behind},
    {"encoder_input_held", false, 50, "m.xeca", true, false, behind},
    {"nothing", false, 50, "encoder.broken_a=0", false, true, ""},
    {"servo_stall", true, 100, "motor.stall", false, false, "does not move as it is driven"},
    {"servo_encoder_dead", true, 100, "encoder.broken_a", false, false, "does not move as it is driven"},
    {"servo_encoder_swapped", true, 100, "encoder.swapped", false, false, behind},
    {"servo_without_voltage", true, 100, "X.drive", true, false, "does not move as it is driven"},
    {"servo_estop", true, 100, "estop", true, true, "emergency stop"},
    {"servo_pushed", true, 100, "motor.push=1000", false, true, ""},
};

class AJogThatBreaks : public testing::TestWithParam<BrokenJog> {};

TEST_P(AJogThatBreaks, IsTrustedAsAProgramIsAndAnAlarmSaysSo) {
    const BrokenJog& one = GetParam();
    Operated o(one.servo ? carriage() : two_axes());
    o.at(0.05, [&](Machine& m) {
        for (const AxisStatus& axis : m.status().axes)
            if (!axis.trusted) {
                EXPECT_TRUE(m.declare_position(axis.letter, axis.commanded));
            }
    });
    for (int n = 2; n < 40; ++n) {
        o.at(0.1 * n, [&, n](Machine& m) { static_cast<void>(m.jog('X', one.speed, {"a", n, n > 2})); });
        if (n == 10)
            o.at(0.1 * n, [&](Machine& m) {
                EXPECT_EQ(m.state(), MachineState::jogging);
                EXPECT_TRUE(m.status().axes[0].trusted);
                const Result<void> broken =
                    one.wire ? m.wires().set(one.fault, 0) : rack::inject_fault(m.rack(), one.fault, "X");
                EXPECT_TRUE(broken) << broken.error().message;
            });
    }
    o.run(6);
    const Status& status = o.machine->status();
    EXPECT_EQ(status.axes[0].trusted, one.trusted);
    std::vector<std::string> alarms;
    for (const Alarm& alarm : status.alarms) alarms.push_back(alarm.text);
    if (*one.alarm == '\0') {
        EXPECT_THAT(alarms, testing::IsEmpty());
    } else {
        EXPECT_THAT(alarms, Contains(HasSubstr(one.alarm)));
    }
}

INSTANTIATE_TEST_SUITE_P(Faults, AJogThatBreaks, testing::ValuesIn(broken_jogs),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(AMachine, TrustsAnAxisAgainThatIsDeclaredAfterItLostSteps) {
    Operated o(two_axes());
    o.at(0.1, [](Machine& m) { EXPECT_TRUE(m.jog_by('X', 20, 50)); });
    o.at(0.3, [](Machine& m) { EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.lose_steps=64", "X")); });
    o.at(2, [](Machine& m) {
        EXPECT_FALSE(m.status().axes[0].trusted);
        EXPECT_THAT(m.line("G1 X1 F600", 1).error().message, HasSubstr("not trusted"));
        EXPECT_TRUE(m.declare_position('X', 12));
    });
    o.at(2.5, [](Machine& m) { EXPECT_TRUE(m.line("G1 X15 F600", 1)); });
    o.run(4);
    EXPECT_TRUE(o.machine->status().axes[0].trusted);
    EXPECT_NEAR(o.x(), 15, 1e-3);
    EXPECT_EQ(o.machine->status().alarms.size(), 1u) << "what was lost before it was declared is told once";
}

}  // namespace
}  // namespace motionrack::operate
