// Wires, parts and faults over the C interface.
#include <gmock/gmock.h>

#include <cmath>
#include <motionrack/frontends/c/test/world.hpp>
#include <string>
#include <utility>

namespace motionrack::c_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// ---- wires

TEST(CWires, SwitchesReachTheCardUntilTheirPinIsForced) {
    World world(with_switches);
    EXPECT_EQ(world.wire("X.limit_plus"), 1);
    world.set("X.limit_plus", 0);
    EXPECT_EQ(world.wire("c1.xlmtp"), 0) << "a stuck switch shows at the pin";
    EXPECT_EQ(world.peek("x.RR2") & 4, 4);
    world.set("c1.xlmtp", 1);
    EXPECT_EQ(world.peek("x.RR2") & 4, 0) << "the pin alone is driven";
    EXPECT_EQ(world.wire("X.limit_plus"), 0);
    world.set("c1.xlmtp", nan_value);
    EXPECT_EQ(world.peek("x.RR2") & 4, 4);
    world.set("X.limit_plus", nan_value);
    EXPECT_EQ(world.peek("x.RR2") & 4, 0);
    world.set("estop", 0);
    EXPECT_EQ(world.wire("c1.emgn"), 0);
    EXPECT_EQ(world.peek("x.RR2") & 0x20, 0x20);
    world.set("estop", nan_value);
    EXPECT_EQ(world.peek("x.RR2") & 0x20, 0);
}

TEST(CWires, OutputsAndOtherValuesAreRefused) {
    World world(with_switches);
    const std::uint64_t before = world.hash();
    for (const char* name : {"c1.xpp", "c1.xout0", "c1.int_n", "X.step", "X.dir", "X.enc_a", "X.enc_b"}) {
        EXPECT_EQ(mr_wire_set(world, name, 1), MR_REFUSED) << name;
        EXPECT_THAT(mr_last_error(), HasSubstr(name));
        world.wire(name);
    }
    for (const double value : {0.5, -1.0, 2.0, 1e300, std::numeric_limits<double>::infinity()})
        EXPECT_EQ(mr_wire_set(world, "c1.xlmtp", value), MR_REFUSED) << value;
    double value = 5;
    for (const char* name : {"", ".", "c1", "c1.", "c1.xlmt", "X.home", "A.enc_a", "Y.step", "estop ", "c1.xdrive2"}) {
        EXPECT_EQ(mr_wire_set(world, name, 1), MR_BAD_CALL) << name;
        EXPECT_EQ(mr_wire_get(world, name, &value), MR_BAD_CALL) << name;
    }
    EXPECT_EQ(value, 5);
    EXPECT_EQ(mr_wire_set(world, "c1.xlmt", 1), MR_BAD_CALL);
    EXPECT_THAT(mr_last_error(), HasSubstr("did you mean 'c1.xlmt"));
    EXPECT_EQ(world.hash(), before);
}

TEST(CWires, PulsesAreReadableAtTheirPin) {
    World world;
    world.write(0x00, 0x010F);
    world.command(1, 0x00, 8'000'000);
    world.command(1, 0x04, 1000);
    world.command(1, 0x05, 1000);  // one pulse per ms, with 50 % duty cycle
    world.command(1, 0x06, 3);
    world.write(0x00, 0x0120);
    int rises = 0;
    for (double before = 0; mr_now_ns(world) < 10'000'000; world.pass(100'000)) {
        const double level = world.wire("c1.xpp");
        EXPECT_EQ(level, world.wire("X.step"));
        rises += level > before;
        before = level;
    }
    EXPECT_EQ(rises, 3);
}

TEST(CWires, EncoderInputsCountForcedLevelsAndThenTheEncoderAgain) {
    World world;
    world.set_up(1, 4000);
    world.command(1, 0x06, 1000);
    world.write(0x00, 0x0120);
    world.pass(1'000'000'000);
    EXPECT_EQ(world.peek("x.EP"), 1000);
    EXPECT_EQ(world.wire("c1.xeca"), 0);  // count 1000: lines 00
    EXPECT_EQ(world.wire("X.enc_a"), 0);
    // Four counts forward by forced lines: A, then B, then A and B back.
    const std::pair<const char*, int> edges[] = {
        {"c1.xeca", 1}, {"c1.xecb", 1}, {"c1.xeca", 0}, {"c1.xecb", 0}, {"c1.xeca", 1}};
    std::int64_t count = 1000;
    for (const auto& [pin, level] : edges) {
        world.set(pin, level);
        EXPECT_EQ(world.wire(pin), level);
        EXPECT_EQ(world.peek("x.EP"), ++count);
    }
    world.set("c1.xeca", 0);
    EXPECT_EQ(world.peek("x.EP"), --count);
    world.write(0x00, 0x0120);
    world.pass(1'000'000'000);
    EXPECT_EQ(world.part("X.position_counts"), 2000);
    EXPECT_EQ(world.peek("x.EP"), count) << "the encoder is cut off";
    world.set("c1.xeca", nan_value);
    EXPECT_EQ(world.peek("x.EP"), count) << "until both inputs are released";
    world.set("c1.xecb", nan_value);
    EXPECT_EQ(world.peek("x.EP"), count) << "the counter goes on from where it is";
    world.write(0x00, 0x0120);
    world.pass(1'000'000'000);
    EXPECT_EQ(world.peek("x.EP"), count + 1000);
    EXPECT_EQ(world.part("X.position_counts"), 3000);
}

/// COMP+ compares with EP: a count forced at the inputs reaches it.
TEST(CWires, ForcedEncoderInputsTriggerComparisons) {
    World world;
    world.write(0x00, 0x010F);
    world.write(0x04, 0x0020);  // WR2: comparison with EP
    world.command(1, 0x0B, 2);  // COMP+ = 2
    world.command(1, 0x0C, 0x8000'0000);
    EXPECT_EQ(world.peek("x.RR1") & 1, 0);
    world.set("c1.xeca", 1);
    world.set("c1.xecb", 1);
    EXPECT_EQ(world.peek("x.EP"), 2);
    EXPECT_EQ(world.peek("x.RR1") & 1, 1);
}

/// Forces the inputs, once with a connected encoder and once with open inputs.
TEST(CWires, CountsUpAndDownPulsesInTheModeForThem) {
    const std::string open = std::string(with_switches) + "[wires]\nc1.xeca = \"open\"\nc1.xecb = \"open\"\n";
    for (const char* text : {one_card, open.c_str()}) {
        World world(text);
        world.write(0x00, 0x010F);
        world.write(0x04, 0x0200);  // WR2: up and down pulses
        world.set("c1.xeca", 0);
        world.set("c1.xecb", 0);
        for (int i = 0; i < 5; ++i) {
            world.set("c1.xeca", 1);
            world.set("c1.xeca", 0);
        }
        world.set("c1.xecb", 1);
        EXPECT_EQ(world.peek("x.EP"), 4);
        EXPECT_EQ(world.part("X.position_counts"), 0);
    }
}

// ---- the machine

TEST(CWires, TheMachineReportsItsTruePositions) {
    World world(with_switches);
    EXPECT_EQ(world.part("X.position_mm"), 10);
    EXPECT_EQ(world.part("A.position_deg"), 0);
    EXPECT_EQ(world.part("X.limit_plus"), 0);
    world.set_up(1, 1000);
    world.command(1, 0x06, 6400);
    world.write(0x00, 0x0120);
    world.pass(500'000'000);
    EXPECT_GT(world.part("X.speed_mm_s"), 10);
    world.pass(1'000'000'000);
    EXPECT_EQ(world.part("X.position_mm"), 20);
    EXPECT_EQ(world.part("X.position_pulses"), 6400);
    EXPECT_EQ(world.part("X.position_counts"), 8000);
    EXPECT_EQ(world.part("X.pulses"), 6400);
    EXPECT_EQ(world.part("X.lost_pulses"), 0);
    EXPECT_EQ(world.part("X.in_step"), 1);
    EXPECT_EQ(world.part("X.speed_mm_s"), 0);
    EXPECT_NEAR(world.part("X.top_speed_mm_s"), 15.6, 0.1);
    double value = 3;
    for (const char* name :
         {"X.position_deg", "X.home", "X", "X.", "", "c1.position_mm", "B.in_step", "A.position_counts"}) {
        EXPECT_EQ(mr_part_get(world, name, &value), MR_BAD_CALL) << name;
        EXPECT_THAT(mr_last_error(), Not(HasSubstr("{")));
    }
    EXPECT_EQ(mr_part_get(world, "X.where", &value), MR_BAD_CALL);
    EXPECT_THAT(mr_last_error(), HasSubstr("position_mm, speed_mm_s"));
    EXPECT_EQ(value, 3);
}

TEST(CWires, APushedMotorStopsAtTheNearestElectricalPhase) {
    World world(with_switches);
    EXPECT_EQ(mr_part_set(world, "X.position_mm", 12.34), MR_OK) << mr_last_error();
    EXPECT_NEAR(world.part("X.position_mm"), 12.34, 32.0 / 640);
    EXPECT_EQ(std::fmod(world.part("X.position_pulses"), 64), 0);
    EXPECT_EQ(world.part("X.lost_pulses"), -world.part("X.position_pulses"));
    EXPECT_EQ(world.peek("x.EP"), world.part("X.position_counts"));
    EXPECT_EQ(world.peek("x.LP"), 0) << "the card knows nothing of it";
    const double there = world.part("X.position_mm");
    EXPECT_EQ(mr_part_set(world, "X.position_mm", there + 0.04), MR_OK);
    EXPECT_EQ(world.part("X.position_mm"), there) << "it springs back";
    EXPECT_EQ(mr_part_set(world, "X.position_mm", 31), MR_OK);
    EXPECT_EQ(world.part("X.limit_plus"), 1);
    world.pass(2'000'000);
    EXPECT_EQ(world.wire("c1.xlmtp"), 0);
    EXPECT_EQ(mr_part_set(world, "X.position_pulses", 0), MR_OK);
    EXPECT_EQ(world.part("X.position_mm"), 10);
    const std::uint64_t before = world.hash();
    for (const double value : {nan_value, std::numeric_limits<double>::infinity(), 1e300, -1e9})
        EXPECT_EQ(mr_part_set(world, "X.position_mm", value), MR_REFUSED) << value;
    EXPECT_EQ(mr_part_set(world, "X.speed_mm_s", 1), MR_REFUSED);
    EXPECT_EQ(mr_part_set(world, "X.limit_plus", 1), MR_REFUSED);
    EXPECT_EQ(mr_part_set(world, "X.nothing", 1), MR_BAD_CALL);
    EXPECT_EQ(world.hash(), before);
}

TEST(CWires, FaultsAreInjectedAndCleared) {
    World world(with_switches);
    world.set_up(1, 1000);
    world.command(1, 0x06, 3200);
    const auto drive = [&] {
        world.write(0x00, 0x0120);
        world.pass(1'000'000'000);
    };
    EXPECT_EQ(mr_fault(world, "motor.stall", "X"), MR_OK);
    drive();
    EXPECT_EQ(world.part("X.position_mm"), 10);
    EXPECT_EQ(world.part("X.in_step"), 0);
    EXPECT_EQ(mr_fault(world, "motor.stall=0", "X"), MR_OK);
    drive();
    EXPECT_EQ(world.part("X.in_step"), 1);
    EXPECT_EQ(world.part("X.lost_pulses"), 3200);
    EXPECT_EQ(world.part("X.position_mm"), 15);
    EXPECT_EQ(mr_fault(world, "motor.lose_steps=128", "X"), MR_OK);
    EXPECT_EQ(world.part("X.lost_pulses"), 3328);
    EXPECT_EQ(mr_fault(world, "limit_minus.stuck_closed", "X"), MR_OK);
    EXPECT_EQ(world.wire("c1.xlmtm"), 0);
    EXPECT_EQ(mr_fault(world, "limit_minus.stuck_closed=0", "X"), MR_OK);
    EXPECT_EQ(world.wire("c1.xlmtm"), 1);
    EXPECT_EQ(mr_fault(world, "encoder.swapped", "X"), MR_OK);
    const double before = world.part("X.position_counts");
    drive();
    EXPECT_NEAR(world.part("X.position_counts"), before - 4000, 2);
}

TEST(CWires, UnknownFaultsListTheKnownOnes) {
    World world(with_switches);
    const std::uint64_t before = world.hash();
    for (const char* fault : {"", "motor", "stall", "motor.stall ", "=1", "watchdog.hang", "motor.explode=1"}) {
        EXPECT_EQ(mr_fault(world, fault, "X"), MR_BAD_CALL) << fault;
        EXPECT_THAT(mr_last_error(), HasSubstr("motor.lose_steps"));
    }
    for (const char* target : {"", "Y", "c1", "XX", "x"}) {
        EXPECT_EQ(mr_fault(world, "motor.stall", target), MR_BAD_CALL) << target;
        EXPECT_THAT(mr_last_error(), HasSubstr("X, A"));
    }
    for (const char* fault : {"motor.push=", "motor.push=1e99", "motor.push=nan", "motor.push=inf", "motor.push=1x",
                              "motor.push=10000001", "home.stuck_open"})
        EXPECT_EQ(mr_fault(world, fault, "X"), MR_REFUSED) << fault;
    EXPECT_EQ(mr_fault(world, "encoder.broken_a", "A"), MR_REFUSED) << "it has no encoder";
    EXPECT_EQ(mr_fault(nullptr, "motor.stall", "X"), MR_BAD_CALL);
    EXPECT_EQ(mr_fault(world, nullptr, "X"), MR_BAD_CALL);
    EXPECT_EQ(mr_fault(world, "motor.stall", nullptr), MR_BAD_CALL);
    EXPECT_EQ(world.hash(), before);
}

}  // namespace
}  // namespace motionrack::c_test
