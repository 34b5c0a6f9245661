// Two servos, each behind a card that positions it alone.
#include <gmock/gmock.h>

#include <tests/text_of.hpp>

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

}  // namespace
}  // namespace motionrack::operate
