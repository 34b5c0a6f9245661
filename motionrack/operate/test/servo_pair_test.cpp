// Two servos, each behind a card that positions it alone.
#include <gmock/gmock.h>

#include <cmath>
#include <motionrack/rack/faults.hpp>
#include <tests/text_of.hpp>
#include <utility>

#include "operated.hpp"

namespace motionrack::operate {
namespace {

rack::RackConfig carriage_and_lift() {
    const rack::RackReading reading = rack::read_rack_text(
        text_of(source_root / "examples/11_carriage/machine.toml") +
        "\n[card.lift]\ntype = \"databoard4002\"\ncard_number = 14\n[axis.Z]\ncard = \"lift\"\nlead_mm = 5\n"
        "encoder_counts_per_rev = 2000\nmax_velocity_mm_s = 100\nmax_accel_mm_s2 = 400\nmax_limit_mm = 500\n"
        "[axis.Z.servo]\nvelocity_per_volt_mm_s = 20\ncoulomb_friction_mm_s2 = 20\n");
    EXPECT_TRUE(reading.config) << (reading.errors.empty() ? "" : reading.errors[0].text());
    return *reading.config;
}

TEST(ServoPair, IsJoggedToAPointAxisByAxis) {
    Operated o(carriage_and_lift());
    o.at(0.05, [](Machine& m) {
        EXPECT_TRUE(m.manual().set_position('X', 100));
        EXPECT_TRUE(m.manual().set_position('Z', 50));
    });
    o.at(0.5, [](Machine& m) {
        control::Point to = m.stream().interpreter().position();
        to[0] = 150, to[2] = 60;
        const Result<void> jogged = m.manual().jog_to(to, 50);
        EXPECT_TRUE(jogged) << jogged.error().message;
    });
    o.run(6);
    EXPECT_EQ(o.machine->state(), MachineState::standstill) << o.machine->status().reason;
    EXPECT_NEAR(o.machine->status().axes[0].commanded, 150, 0.3);
    EXPECT_NEAR(o.machine->status().axes[1].commanded, 60, 0.3);
}

TEST(ServoPair, LosesThePositionOfTheCardThatIsWritten) {
    Operated o(carriage_and_lift());
    o.at(0.05, [](Machine& m) {
        EXPECT_TRUE(m.manual().set_position('X', 100));
        EXPECT_TRUE(m.manual().set_position('Z', 50));
    });
    o.at(0.5, [](Machine& m) {
        constexpr std::uint32_t unused_port = 2;
        EXPECT_TRUE(m.manual_access().request({"lift", 8, unused_port, 0}, [](const auto&) {}));
    });
    o.at(0.6, [](Machine& m) {
        EXPECT_TRUE(m.status().axes[0].position_valid);
        EXPECT_FALSE(m.status().axes[1].position_valid);
        EXPECT_TRUE(m.manual().jog_by('X', 5, 20)) << "no axis is moved by the write";
    });
    o.run(2);
    EXPECT_NEAR(o.machine->status().axes[0].commanded, 105, 0.3);
}

/// Two servos that are jogged, of which X stalls. The parameter: a reset while the other one still brakes.
class StalledServo : public testing::TestWithParam<bool> {
  protected:
    StalledServo() : o_(carriage_and_lift()) {
        o_.at(0.05, [](Machine& m) {
            EXPECT_TRUE(m.manual().set_position('X', 100));
            EXPECT_TRUE(m.manual().set_position('Z', 20));
        });
        o_.at(0.5, [](Machine& m) { EXPECT_TRUE(m.manual().jog_by('Z', 450, 100)); });
        for (int i = 0; i < 50; ++i)
            o_.at(0.5 + 0.05 * i, [i](Machine& m) { static_cast<void>(m.manual().jog('X', 50, {"a", i + 1, i > 0})); });
        o_.at(1, [this](Machine& m) {
            EXPECT_EQ(m.state(), MachineState::jogging);
            EXPECT_TRUE(rack::inject_fault(m.rack(), "motor.stall", "X"));
            o_.each_status([this](const Status& status) { observe(status); });
        });
    }
    /// Adds up the motion of Z while the machine reports that nothing moves.
    void observe(const Status& status) {
        const bool is_idle = idle(status.state);
        if (is_idle && was_idle_) moved_idle_ += std::fabs(status.axes[1].commanded - z_);
        was_idle_ = is_idle;
        z_ = status.axes[1].commanded;
        if (status.state != MachineState::jogging && std::exchange(resets_, false)) o_.machine->reset();
    }

    Operated o_;
    bool resets_ = GetParam(), was_idle_ = false;
    double z_ = 0, moved_idle_ = 0;
};

TEST_P(StalledServo, StopsTheOtherOneBeforeTheErrorStop) {
    o_.run(6);
    const Status& status = o_.machine->status();
    EXPECT_LT(moved_idle_, 0.05) << "it stood whenever the machine said so";
    EXPECT_EQ(status.state, GetParam() ? MachineState::standstill : MachineState::error_stop);
    EXPECT_THAT(o_.states, testing::Contains("stopping"));
    EXPECT_LT(z_, 350) << "its jog of 450 mm has ended, too";
    EXPECT_FALSE(status.axes[0].position_valid);
    EXPECT_TRUE(status.axes[1].position_valid);
    ASSERT_THAT(status.alarms, testing::SizeIs(1));
    EXPECT_EQ(status.alarms[0].source, "jog");
    EXPECT_THAT(status.alarms[0].text, testing::HasSubstr("Axis X does not follow"));
}

INSTANTIATE_TEST_SUITE_P(AndAReset, StalledServo, testing::Bool(),
                         [](const auto& each) { return each.param ? "WhileItBrakes" : "Never"; });

}  // namespace
}  // namespace motionrack::operate
