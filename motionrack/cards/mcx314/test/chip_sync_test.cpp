// Tests of the synchronous actions of the MCX314As through registers and pins.
#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

struct As : Bench {
    As() : Bench(Variant::mcx314as) { start(); }
    void actions(unsigned axes, unsigned conditions, unsigned to_do) {
        data(axes, cmd::SM, std::int64_t{to_do} << 16 | conditions);
    }
    std::int32_t buffer(unsigned axis) { return counter(axis, cmd::READ_BR); }
};

constexpr unsigned at_comp_plus = field("SM6", "PGECP").mask, drive_starts = field("SM6", "DSTA").mask,
                   drive_ends = field("SM6", "DEND").mask, in3_rises = field("SM6", "IN3UP").mask,
                   in3_falls = field("SM6", "IN3DN").mask, lp_read = field("SM6", "LPRD").mask,
                   by_command = field("SM6", "CMD").mask, first_other = 0x2000, second_other = 0x4000,
                   third_other = 0x8000;
constexpr unsigned drive_plus = field("SM7", "FDRVP").mask, drive_minus = field("SM7", "FDRVM").mask,
                   run_plus = field("SM7", "CDRVP").mask, slow_stop = field("SM7", "SSTOP").mask,
                   quick_stop = field("SM7", "ISTOP").mask, save_lp = field("SM7", "LPSAV").mask,
                   save_ep = field("SM7", "EPSAV").mask, set_lp = field("SM7", "LPSET").mask,
                   set_ep = field("SM7", "EPSET").mask, set_p = field("SM7", "OPSET").mask,
                   set_v = field("SM7", "VLSET").mask, out = field("SM7", "OUT").mask,
                   interrupt = field("SM7", "INT").mask;

TEST(ChipSync, AnAxisThatReachesCompPlusStartsAnotherInTheSameTick) {
    Bench b(Variant::mcx314as);
    EdgeLog x, y;
    b.start();
    b.chip.pulses(0).set_edge_listener(&x);
    b.chip.pulses(1).set_edge_listener(&y);
    b.speeds(X | Y, 16'000, 800, 800);  // a pulse every 20 ticks
    b.data(X, cmd::COMP_PLUS, 15);
    b.data(X | Y, cmd::P, 30);
    b.data(X, cmd::SM, at_comp_plus | first_other);
    b.data(Y, cmd::SM, std::int64_t{drive_plus} << 16);
    b.command(X, 0x20);
    b.advance(milliseconds(1));
    ASSERT_EQ(x.list.size(), 30u);
    ASSERT_EQ(y.list.size(), 30u);
    // A command after that tick would make its first pulse 2 + 20 ticks later.
    EXPECT_EQ(y.list[0].tick, x.list[14].tick + 22);
    EXPECT_EQ(b.lp(Y), 30);
}

TEST(ChipSync, AConditionSavesTheCounterAtItsPulse) {
    As b;
    b.speeds(X, 16'000, 8000, 8000);
    b.data(X, cmd::COMP_PLUS, 12'345);
    b.data(X, cmd::P, 20'000);
    b.actions(X, at_comp_plus, save_lp);
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.buffer(X), 12'345);
    EXPECT_EQ(b.lp(X), 20'000);
}

TEST(ChipSync, Input3SavesThePositionOfAllAxesAtTheSameInstant) {
    As b;
    b.speeds(X, 16'000, 8000, 8000);
    b.speeds(Y, 16'000, 4000, 4000);
    b.actions(X, in3_falls | first_other, save_lp | interrupt);
    b.actions(Y, 0, save_lp);
    b.command(X | Y, 0x22);
    b.advance(tick * 1000 + tick / 2);
    b.wire("xin3", 0);
    b.advance(tick / 2);
    EXPECT_TRUE(b.interrupt());
    EXPECT_EQ(b.status(X, 3), 0x0200u);
    EXPECT_FALSE((b.kernel.settle(), b.interrupt())) << "reading RR3 clears it";
    EXPECT_EQ(b.buffer(X), b.lp(X));
    EXPECT_EQ(b.buffer(Y), b.lp(Y));
    b.advance(tick * 100);
    b.wire("xin3", 1);  // the rise of IN3 is not a selected condition
    b.advance(tick * 10);
    EXPECT_LT(b.buffer(X), b.lp(X));
    EXPECT_EQ(b.status(X, 3), 0u);
}

TEST(ChipSync, TheEndOfADriveStartsTheNextAxisAndItsStartTheOneAfter) {
    As b;
    b.speeds(X | Y | Z, 16'000, 800, 800);
    b.data(X | Y | Z, cmd::P, 10);
    b.actions(X, drive_ends | second_other, 0);
    b.actions(Z, drive_starts | second_other, drive_minus);  // Z's second other axis is Y
    b.actions(Y, 0, drive_plus);
    b.command(X, 0x20);
    b.advance(tick * 202);
    EXPECT_EQ(b.count(0), 10);
    EXPECT_EQ(b.read(0) & 0xFu, Z) << "Z starts in the tick in which X ends";
    b.advance(tick);
    EXPECT_EQ(b.read(0) & 0xFu, Y | Z) << "and Y a tick later";
    b.actions(Y | Z, 0, 0);
    ASSERT_TRUE(b.finish(Y | Z));
    EXPECT_EQ(b.lp(Z), -10);
    EXPECT_EQ(b.lp(Y), 10);
}

TEST(ChipSync, CommandsAndReadingLpAreConditions) {
    As b;
    b.speeds(U, 16'000, 8000, 8000);
    b.data(U, cmd::LP, 77);
    b.actions(U, lp_read | by_command, save_lp | set_lp);
    b.write(7, 0);
    b.write(6, 500);
    EXPECT_EQ(b.lp(U), 77) << "what is read is the counter before the action";
    EXPECT_EQ(b.buffer(U), 77);
    b.write(6, 600);
    b.command(U, cmd::SYNC);
    EXPECT_EQ(b.buffer(U), 500);
    b.actions(U, by_command | third_other, save_ep | set_ep);  // U's third other axis is Z
    b.actions(Z, 0, set_lp);
    b.write(7, 0);
    b.write(6, 4);
    b.command(U, cmd::SYNC);
    EXPECT_EQ(b.ep(U), 4);
    EXPECT_EQ(b.lp(Z), 4);
    EXPECT_EQ(b.lp(Y), 0);
}

TEST(ChipSync, ActionsChangeSpeedAndTargetAndStop) {
    As b;
    b.speeds(X, 16'000, 8000, 8000);
    b.speeds(Y, 80'000, 100, 1000, 2000);
    b.data(X, cmd::COMP_PLUS, 1000);
    b.data(X, cmd::P, 5000);
    b.data(Y, cmd::P, 1'000'000);
    b.actions(X, at_comp_plus | first_other, 0);
    b.actions(Y, 0, set_v);
    b.command(Y, 0x22);
    b.advance(milliseconds(20));
    b.write(6, 2000);
    b.command(X, 0x20);
    b.advance(milliseconds(20));
    EXPECT_EQ(b.cv(Y), 2000);
    b.data(X, cmd::LP, 0);
    b.actions(Y, 0, slow_stop);
    b.command(X, 0x20);
    b.advance(tick * 2010);
    EXPECT_NE(b.status(Y, 1) & 0x10u, 0u) << "decelerates";
    ASSERT_TRUE(b.finish(X | Y));
    b.actions(Y, 0, set_p | drive_plus);
    b.data(X, cmd::LP, 0);
    b.write(7, 0);
    b.write(6, 50);
    const std::int32_t from = b.lp(Y);
    b.write(7, 0);
    b.write(6, 50);
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X | Y));
    EXPECT_EQ(b.lp(Y) - from, 50);
    b.actions(Y, 0, run_plus);
    b.data(X, cmd::LP, 0);
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.read(0) & Y, Y);
    b.actions(Y, 0, quick_stop);
    b.data(X, cmd::LP, 0);
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X));
    EXPECT_EQ(b.read(0) & Y, 0u);
}

TEST(ChipSync, AnActionMayGiveTheClearPulse) {
    As b;
    b.data(X, cmd::EM, 0x0800'0000);  // DCCE, 10 us
    b.actions(X, in3_rises, out);
    b.wire("xin3", 0);
    b.advance(microseconds(1));
    EXPECT_EQ(b.level("xdrive"), 0);
    b.wire("xin3", 1);
    b.advance(tick);
    EXPECT_EQ(b.level("xdrive"), 1);
    b.advance(microseconds(10));
    EXPECT_EQ(b.level("xdrive"), 0);
}

TEST(ChipSync, TwoAxesThatStartEachOtherDoNotHangTheChip) {
    As b;
    b.speeds(X | Y, 16'000, 8000, 8000);
    b.data(X | Y, cmd::P, 1);
    b.actions(X | Y, drive_ends | first_other, 0);
    b.actions(X, drive_ends | first_other, drive_plus);
    b.actions(Y, drive_ends | first_other, drive_plus);
    b.command(X, 0x20);
    b.advance(milliseconds(1));
    EXPECT_GT(b.lp(X), 500);
    EXPECT_GT(b.lp(Y), 500);
    b.actions(X | Y, 0, 0);
    EXPECT_TRUE(b.finish(X | Y));
}

}  // namespace
}  // namespace motionrack::mcx314::outside
