// Tests of drives and steps on request: single steps by command and by wire, drives by nEXPP and nEXPM, the 8-bit bus.
#include <gtest/gtest.h>

#include <cstring>
#include <motionrack/cards/mcx314/chip/byte_bus.hpp>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

// A line of X and Y that waits for its steps; X would step every 10 ticks.
class Steps : public Bench {
  public:
    explicit Steps(unsigned wr5, std::int64_t x = 3, std::int64_t y = -1) {
        start();
        speeds(X | Y, 20'000, 2000, 2000);
        write(5, 0x0004 | wr5);
        data(X, cmd::P, x);
        data(Y, cmd::P, y);
        command(0, cmd::LINE2);
        advance(tick * 100);
    }
    void step() { command(0, cmd::STEP); }
    /// Sets EXPLSN Low half a tick after a tick, for `ticks`.
    void pull(int ticks) {
        advance(tick / 2);
        wire("expls_n", 0);
        advance(tick * ticks);
        wire("expls_n", 1);
        advance(tick / 2);
    }
};
constexpr unsigned request_by_command = 0x1000, by_wire = 0x0800;

TEST(ChipSteps, EachCommandMakesOneBasicPulse) {
    Steps b(request_by_command);
    EXPECT_EQ(b.count(0), 0) << "nothing comes by itself";
    EXPECT_TRUE(field("RR0", "IDRV").test(b.read(0)));
    for (int n = 1; n <= 3; ++n) {
        b.step();
        b.advance(tick * 9);
        EXPECT_EQ(b.count(0), n - 1);
        b.advance(tick);
        EXPECT_EQ(b.count(0), n) << "one period of the speed after the command";
        b.advance(tick * 50);
    }
    EXPECT_EQ(b.count(0), 3);
    EXPECT_EQ(b.count(1), -1);
    EXPECT_FALSE(field("RR0", "IDRV").test(b.read(0)));
    EXPECT_TRUE(b.kernel.conditions().empty());
}

TEST(ChipSteps, ACommandWhileAStepIsUnderWayIsIgnored) {
    Steps b(request_by_command);
    b.step();
    b.step();
    b.advance(tick * 200);
    EXPECT_EQ(b.count(0), 1);
    ASSERT_EQ(b.kernel.conditions().size(), 1u);
    EXPECT_EQ(b.kernel.conditions().back().code, step_ignored);
    b.command(X, cmd::QUICK_STOP);
    b.advance(tick);
    b.step();
    EXPECT_EQ(b.kernel.conditions().size(), 2u) << "nothing waits for a step";
}

TEST(ChipSteps, AStepIsRequestedWhenTheWireIsLowForFourClocks) {
    Steps b(by_wire);
    b.pull(1);
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 0) << "Low at one tick only";
    b.pull(2);
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 1);
    b.pull(500);
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 2) << "once, however long";
    b.step();
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 2) << "3Ah is for CMPLS";
    b.pull(2);
    b.advance(tick * 8);
    EXPECT_EQ(b.count(0), 2);
    b.advance(tick);
    EXPECT_EQ(b.count(0), 3);
    EXPECT_FALSE(field("RR0", "IDRV").test(b.read(0)));
}

TEST(ChipSteps, AStopBetweenStepsIsImmediateEvenAtSpeed) {
    Steps b(request_by_command);
    b.data(X, cmd::SV, 100);
    b.command(X, cmd::SLOW_STOP);
    b.advance(tick);
    EXPECT_FALSE(field("RR0", "IDRV").test(b.read(0)));
}

TEST(ChipSteps, AQueuedSegmentHasTheStepsOfItsOwnCommand) {
    Steps b(request_by_command, 2, 0);
    b.write(5, 0x0004);
    b.data(X, cmd::P, 5);
    b.command(0, cmd::LINE2);
    b.step();
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 1);
    b.step();
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 7) << "the second segment runs by itself";
}

TEST(ChipSteps, ExecutesABitPatternInSingleSteps) {
    Steps b(request_by_command);
    b.command(X, cmd::QUICK_STOP);
    b.advance(tick);
    b.command(0, cmd::BP_ENABLE);
    b.write(2, 0x0005);  // BP1P, BP1M
    b.write(3, 0x0002);
    b.write(5, 0x0007);  // BP2M
    b.command(0, cmd::BP_STACK);
    b.command(0, cmd::BP2);
    const std::array<std::array<std::int64_t, 2>, 3> places = {{{1, -1}, {0, -2}, {1, -3}}};
    for (const auto& place : places) {
        b.step();
        b.advance(tick * 30);
        EXPECT_EQ(b.count(0), place[0]);
        EXPECT_EQ(b.count(1), place[1]);
    }
}

// ---- nEXPP and nEXPM

class ByHand : public Bench {
  public:
    explicit ByHand(unsigned exop) {
        start();
        speeds(X | Y, 20'000, 2000, 2000);
        data(X | Y, cmd::P, 7);
        mode(X, 3, exop << 3);
        advance(tick * 4);
    }
};

TEST(ChipExternalDrive, DrivesWhileTheInputIsLow) {
    ByHand b(1);
    b.wire("xexpp", 0);
    b.advance(tick * 2 + tick * 2 + tick * 99);
    EXPECT_EQ(b.count(0), 9) << "two ticks Low, two of the command, then a pulse every ten";
    EXPECT_TRUE(b.read(0) & X);
    b.wire("xexpp", 1);
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 10);
    EXPECT_FALSE(b.read(0) & X);
    b.wire("xexpm", 0);
    b.advance(tick * 54);
    EXPECT_EQ(b.count(0), 5);
    b.wire("yexpp", 0);
    b.advance(tick * 100);
    EXPECT_EQ(b.count(1), 0) << "Y is not switched to it";
}

TEST(ChipExternalDrive, AContinuousDriveDeceleratesIfItAccelerated) {
    ByHand b(1);
    b.data(X, cmd::SV, 200);
    b.wire("xexpm", 0);
    b.advance(milliseconds(100));
    EXPECT_EQ(b.cv(X), 2000);
    b.wire("xexpm", 1);
    b.advance(milliseconds(1));
    EXPECT_TRUE(field("RR1", "DSND").test(b.status(X, 1)));
    EXPECT_TRUE(b.finish(X));
    EXPECT_EQ(b.status(X, 1) & 0xFF00u, 0u);
}

TEST(ChipExternalDrive, AFixedDriveStartsAtTheFallingEdge) {
    ByHand b(2);
    b.wire("xexpm", 0);
    b.advance(tick);
    b.wire("xexpm", 1);
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 0) << "Low at one tick only";
    b.wire("xexpm", 0);
    b.advance(tick * 2);
    b.wire("xexpm", 1);
    b.advance(tick * 200);
    EXPECT_EQ(b.count(0), -7);
    b.wire("xexpp", 0);
    b.advance(tick * 20);
    b.wire("xexpp", 1);
    b.advance(tick * 4);
    b.wire("xexpp", 0);
    b.advance(tick * 500);
    EXPECT_EQ(b.count(0), 0) << "an edge during the drive is ignored";
    EXPECT_TRUE(b.kernel.conditions().empty());
}

TEST(ChipExternalDrive, AnInputThatIsAlreadyLowMustGoHighFirst) {
    ByHand b(0);
    b.wire("xexpp", 0);
    b.mode(X, 3, 1 << 3);
    b.advance(tick * 100);
    EXPECT_EQ(b.count(0), 0);
    b.wire("xexpp", 1);
    b.advance(tick * 2);
    b.wire("xexpp", 0);
    b.advance(tick * 54);
    EXPECT_EQ(b.count(0), 5);
    b.mode(X, 3, 0);
    b.advance(tick * 50);
    EXPECT_FALSE(b.read(0) & X) << "switched off it stops like at High";
}

TEST(ChipExternalDrive, ALimitEndsTheDriveAndItDoesNotRestart) {
    ByHand b(1);
    b.wire("xexpp", 0);
    b.advance(tick * 50);
    b.wire("xlmtp", 0);
    b.advance(tick * 2);
    EXPECT_FALSE(b.read(0) & X);
    b.wire("xlmtp", 1);
    const std::int64_t there = b.count(0);
    b.advance(tick * 500);
    EXPECT_EQ(b.count(0), there);
    EXPECT_TRUE(field("RR1", "LMTP").test(b.status(X, 1)));
}

TEST(ChipExternalDrive, AHeldAxisDoesNotMove) {
    ByHand b(2);
    b.command(X, cmd::HOLD);
    b.wire("xexpp", 0);
    b.advance(tick * 500);
    b.command(X, cmd::START);
    b.advance(tick * 500);
    EXPECT_EQ(b.count(0), 0);
}

// ---- 8-bit bus

TEST(ChipBytes, TheLowByteOfWr0ExecutesTheCommand) {
    Bench b;
    ByteBus bus(b.chip);
    b.start();
    b.speeds(X, 20'000, 2000, 2000);
    bus.out(14, 0), bus.out(15, 0);   // WR7
    bus.out(12, 44), bus.out(13, 1);  // WR6 = 300
    bus.out(1, X);
    EXPECT_EQ(b.chip.peek(0) & X, 0);
    bus.out(0, cmd::P);
    bus.out(0, cmd::FIXED_PLUS);  // for the axes selected by the last write of the high byte
    b.advance(milliseconds(1));
    EXPECT_EQ(b.count(0), 300);
    bus.out(1, X);
    bus.out(0, cmd::READ_LP);
    const std::uint8_t low = bus.in(12), high = bus.in(13);
    EXPECT_EQ(low | high << 8, 300);
}

TEST(ChipBytes, AByteReplacesItsHalfOfTheRegister) {
    Bench b;
    ByteBus bus(b.chip);
    b.start();
    bus.out(9, 0x10), bus.out(8, 0x02);  // WR4
    b.kernel.settle();
    EXPECT_EQ(b.level("xout1"), 1);
    EXPECT_EQ(b.level("uout0"), 1);
    bus.out(9, 0x00);
    b.kernel.settle();
    EXPECT_EQ(b.level("xout1"), 1);
    EXPECT_EQ(b.level("uout0"), 0);
    b.command(X | Z, cmd::NOP);
    bus.out(5, 0x30);  // ALARM of X and Z, active High
    EXPECT_TRUE(field("RR2", "ALARM").test(b.status(Z, 2)));
    EXPECT_FALSE(field("RR2", "ALARM").test(b.status(Y, 2)));
    EXPECT_TRUE(field("RR2", "ALARM").test(b.status(X, 2)));
}

TEST(ChipBytes, AByteOfRr3ClearsItsOwnFlags) {
    Bench b;
    ByteBus bus(b.chip);
    b.start();
    b.mode(X, 1, 0x8000);
    b.data(X, cmd::P, 0);
    b.command(X, cmd::FIXED_PLUS);
    b.advance(tick * 10);
    ASSERT_TRUE(b.interrupt());
    EXPECT_EQ(bus.in(7), 0);
    b.kernel.settle();
    EXPECT_TRUE(b.interrupt()) << "D-END is in the other byte";
    EXPECT_EQ(bus.in(6), 0x80);
    b.kernel.settle();
    EXPECT_FALSE(b.interrupt());
}

TEST(ChipBytes, LibraryCallsHaveTheSameEffectAsOnThe16BitBus) {
    Bench wide, narrow;
    ByteBus bus(narrow.chip);
    sim::RegisterDevice* const devices[] = {&wide.chip, &bus};
    for (sim::RegisterDevice* device : devices) {
        Bench& b = device == &bus ? narrow : wide;
        b.start();
        for (const auto& [offset, value] : std::vector<std::array<unsigned, 2>>{{14, 0},
                                                                                {12, 20'000},
                                                                                {0, 0x0300},
                                                                                {12, 2000},
                                                                                {0, 0x0304},
                                                                                {0, 0x0305},
                                                                                {12, 200},
                                                                                {0, 0x0302},
                                                                                {12, 500},
                                                                                {0, 0x0106},
                                                                                {12, 211},
                                                                                {0, 0x0206},
                                                                                {10, 0x0004},
                                                                                {0, 0x010F},
                                                                                {2, 0x8100},
                                                                                {0, 0x0030}})
            device->write(offset, static_cast<std::uint16_t>(value));
        b.advance(microseconds(300));
    }
    EXPECT_EQ(wide.count(0), narrow.count(0));
    EXPECT_GT(wide.count(0), 100);
    for (std::uint32_t offset = 0; offset < 16; offset += 2)
        EXPECT_EQ(wide.chip.read(offset), bus.read(offset)) << offset;
    EXPECT_EQ(wide.chip.peek(6), bus.peek(6));
}

}  // namespace
}  // namespace motionrack::mcx314::outside
