// Tests of the pins of the chip: pulse outputs, encoder inputs, general outputs; and of listeners and snapshots.
#include <gmock/gmock.h>

#include <motionrack/cards/mcx314/chip/general_outputs.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>
#include <string>

namespace motionrack::mcx314::outside {
namespace {

using Change = WireLog::Change;

void short_drive(Bench& b, unsigned axes, int pulses, unsigned code) {
    b.speeds(axes, 16'000, 1000, 1000);  // a pulse every 16 ticks, 8 ticks wide
    b.data(axes, 0x06, pulses);
    b.command(axes, code);
}

TEST(ChipWires, TwoPulseModeHasAWireForEachDirection) {
    Bench b;
    WireLog log(b.kernel);
    Follower follower(b.kernel);
    for (const char* wire : {"c.xpp", "c.xpm"}) follower.listen(wire);
    b.start();
    for (const char* wire : {"c.xpp", "c.xpm"}) follower.follow(wire, true);
    short_drive(b, X, 2, 0x20);
    b.advance(microseconds(10));
    short_drive(b, X, 1, 0x21);
    b.advance(microseconds(10));
    // After a start at tick 0 the generator works from tick 3 on: pulses at ticks 18 and 34.
    EXPECT_EQ(log.of("c.xpp"),
              (std::vector<Change>{{"c.xpp", 1, 18}, {"c.xpp", 0, 26}, {"c.xpp", 1, 34}, {"c.xpp", 0, 42}}));
    EXPECT_EQ(log.of("c.xpm"), (std::vector<Change>{{"c.xpm", 1, 98}, {"c.xpm", 0, 106}}));
    EXPECT_EQ(b.lp(X), 1);
}

TEST(ChipWires, OnePulseModeHasADirectionAndLevelsCanBeInverted) {
    Bench b;
    WireLog log(b.kernel);
    Follower follower(b.kernel);
    for (const char* wire : {"c.ypp", "c.ypm"}) follower.listen(wire);
    b.start();
    b.mode(Y, 2, 0x00C0);  // one pulse, negative logic; DIR-L 0: + is Low
    for (const char* wire : {"c.ypp", "c.ypm"}) follower.follow(wire, true);
    EXPECT_EQ(b.level("ypp"), 1);
    short_drive(b, Y, 1, 0x21);
    b.kernel.settle();
    EXPECT_EQ(b.level("ypm"), 1);  // before any pulse
    b.advance(microseconds(10));
    EXPECT_EQ(log.of("c.ypp"), (std::vector<Change>{{"c.ypp", 0, 18}, {"c.ypp", 1, 26}}));
    short_drive(b, Y, 1, 0x20);
    b.kernel.settle();
    EXPECT_EQ(b.level("ypm"), 0);
}

TEST(ChipWires, AWireWithoutAListenerHasTheSameLevelsWithoutEvents) {
    Bench seen, followed;
    Follower follower(followed.kernel);
    for (const char* wire : {"c.xpp", "c.ypp", "c.ypm"}) follower.listen(wire);
    for (Bench* b : {&seen, &followed}) {
        b->start();
        b->write(5, 0x0024);
    }
    for (const char* wire : {"c.xpp", "c.ypp", "c.ypm"}) follower.follow(wire, true);
    for (Bench* b : {&seen, &followed}) {
        b->speeds(X, 50'000, 100, 4000, 8000);
        b->data(X, 0x06, 300);
        b->data(Y, 0x06, -211);
        b->command(0, 0x30);
    }
    int pulses = 0, before = 0;
    for (int i = 0; i < 60'000; ++i) {
        seen.advance(tick);
        followed.advance(tick);
        for (const char* wire : {"xpp", "ypp", "ypm"})
            ASSERT_EQ(seen.level(wire), followed.level(wire)) << wire << " at tick " << i + 1;
        pulses += seen.level("ypm") > before;
        before = seen.level("ypm");
    }
    EXPECT_EQ(seen.lp(X), 300);
    EXPECT_EQ(pulses, 211);
}

TEST(ChipWires, CostsNoEventsWithoutAListener) {
    Bench b;
    b.start();
    b.speeds(X, 16'000, 8000, 8000);
    b.data(X, 0x06, 4'000'000);
    b.command(X, 0x20);
    const std::uint64_t before = b.kernel.events();
    b.advance(whole_seconds(2));
    EXPECT_EQ(b.lp(X), 4'000'000);
    EXPECT_LT(b.kernel.events() - before, 20u);
}

TEST(ChipWires, GeneralOutputsFollowWr4AndWr3OrTheDrivesStatus) {
    Bench b;
    WireLog log(b.kernel);
    Follower follower(b.kernel);
    follower.listen("c.xout6");
    b.start();
    b.write(4, 0x8421);
    b.kernel.settle();
    EXPECT_EQ(b.level("xout0"), 1);
    EXPECT_EQ(b.level("xout1"), 0);
    EXPECT_EQ(b.level("yout1"), 1);
    EXPECT_EQ(b.level("zout2"), 1);
    EXPECT_EQ(b.level("uout3"), 1);
    b.mode(Z, 3, 0x0A00);
    EXPECT_EQ(b.level("zout4"), 0);
    EXPECT_EQ(b.level("zout5"), 1);
    EXPECT_EQ(b.level("zout7"), 1);
    follower.follow("c.xout6", true);
    b.mode(X, 3, 0x0080);  // nOUT6 is ASND
    b.speeds(X, 80'000, 100, 200, 100);
    b.data(X, 0x06, 2000);
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X));
    const auto changes = log.of("c.xout6");
    ASSERT_EQ(changes.size(), 2u);
    EXPECT_EQ(changes[0].level, 1);
    EXPECT_EQ(changes[1].tick - changes[0].tick, 63'999);  // 100 V units of 640 ticks each, less one tick
}

TEST(ChipWires, ClearedGeneralOutputsAreLowAndTheSelectedAxesAndTheShownStatusStay) {
    Bench b;
    WireLog log(b.kernel);
    Follower follower(b.kernel);
    for (const char* wire : {"c.yout5", "c.uout7"}) follower.listen(wire);
    b.start();
    for (const char* wire : {"c.yout5", "c.uout7"}) follower.follow(wire, true);
    b.write(4, 0xFFFF);
    b.mode(X | Y | Z | U, 3, 0x0F04);  // OUT4..7 high, S-curve
    b.mode(X, 3, 0x0F80);              // X shows its drive status: CMP+ and CMP- at standstill
    const auto shown = b.level("xout4");
    b.kernel.settle();
    EXPECT_EQ(b.level("yout5"), 1);
    b.command(Z, 0x0F);
    Chip::GeneralOutputs::clear(b.chip);
    b.kernel.settle();
    for (const char channel : std::string("xyzu"))
        for (int output = 0; output < (channel == 'x' ? 4 : 8); ++output)
            EXPECT_EQ(b.level(channel + std::string("out") + std::to_string(output)), 0) << channel << output;
    EXPECT_EQ(b.level("xout4"), shown);
    EXPECT_EQ(b.chip.inspect("WR3", 0), 0x0080);
    EXPECT_EQ(b.chip.inspect("WR3", 1), 0x0004) << "the other modes stay";
    EXPECT_EQ(log.of("c.yout5").size(), 2u) << "whoever follows an output sees it fall";
    EXPECT_EQ(log.of("c.uout7").size(), 2u);
    b.write(3, 0);
    b.write(3, 0x0100);
    EXPECT_EQ(b.level("zout4"), 1) << "Z is still selected";
    EXPECT_EQ(b.level("yout4"), 0);
}

/// A host writes whole words, with the bits that it remembers from before the stop.
TEST(ChipWires, AClearedOutputStaysLowUntilItIsWrittenLow) {
    Bench b;
    b.start();
    b.write(4, 0x0003);    // X OUT0, OUT1
    b.mode(Y, 3, 0x0304);  // nOUT4 and nOUT5 of Y, S-curve
    Chip::GeneralOutputs::clear(b.chip);
    const auto told = [&] {
        std::vector<std::string> out;
        for (const sim::Condition& one : b.kernel.conditions()) out.push_back(describe(one, "c"));
        return out;
    };
    b.write(4, 0x0013);  // also Y OUT0, which was low
    EXPECT_EQ(b.level("xout0"), 0);
    EXPECT_EQ(b.level("xout1"), 0);
    EXPECT_EQ(b.level("yout0"), 1);
    EXPECT_EQ(b.chip.inspect("WR4", 0), 0x0010) << "as the outputs are";
    EXPECT_THAT(told(), testing::ElementsAre("c: outputs stay low, bits 0003h of WR4: a stop of the machine cleared "
                                             "them; write them low first, then high"));
    b.mode(Y, 3, 0x0300);  // a drive without an S-curve
    EXPECT_EQ(b.level("yout4"), 0);
    EXPECT_EQ(b.level("yout5"), 0);
    EXPECT_EQ(told().size(), 1u) << "once is enough";
    b.write(4, 0x0012);  // X OUT0 low
    b.write(4, 0x0013);
    EXPECT_EQ(b.level("xout0"), 1);
    EXPECT_EQ(b.level("xout1"), 0) << "never written low";
    b.mode(Y, 3, 0x0200);
    b.mode(Y, 3, 0x0300);
    EXPECT_EQ(b.level("yout4"), 1);
    EXPECT_EQ(b.level("yout5"), 0);
    b.write(0, 0x8000);  // a reset of the chip allows the outputs again
    b.write(4, 0x0003);
    EXPECT_EQ(b.level("xout1"), 1);
}

TEST(ChipEncoder, EveryDivisionCountsItsEdges) {
    const struct {
        unsigned wr2;
        int up, back;  // EP after 9 counts up, and after 5 of them back
    } cases[] = {{0x0000, 9, 4}, {0x0400, 5, 2}, {0x0800, 3, 1}, {0x0200, 9, 4}};
    for (const auto& c : cases) {
        Bench b;
        HandWheel wheel;
        b.chip.connect_encoder(0, wheel);
        b.start();
        b.mode(X, 2, c.wr2);
        wheel.turn(9, b.kernel.now());
        EXPECT_EQ(b.ep(X), c.up) << c.wr2;
        wheel.turn(4, b.kernel.now());
        EXPECT_EQ(b.ep(X), c.back) << c.wr2;
        b.data(X, 0x0A, 1000);
        EXPECT_EQ(b.ep(X), 1000);
        wheel.turn(8, b.kernel.now());
        EXPECT_EQ(b.ep(X), 1000 + (c.wr2 == 0x0400 ? 2 : c.wr2 == 0x0800 ? 1 : 4));
    }
}

TEST(ChipEncoder, EpWrapsAt32Bits) {
    Bench b;
    HandWheel wheel;
    b.chip.connect_encoder(1, wheel);
    b.start();
    b.data(Y, 0x0A, 0x7FFF'FFFF);
    wheel.turn(2, b.kernel.now());
    EXPECT_EQ(b.ep(Y), -0x7FFF'FFFF);
}

TEST(ChipEncoder, AComparisonWithEpInterruptsWhenTheEncoderPassesIt) {
    Bench b;
    HandWheel wheel;
    b.chip.connect_encoder(0, wheel);
    b.start();
    b.mode(X, 2, 0x0020);  // compare EP
    b.data(X, 0x0B, 100);
    wheel.turn(150, b.kernel.now());  // not enabled yet, so not latched
    b.mode(X, 1, 0x1800);             // P < C+ and P >= C+
    b.kernel.settle();
    EXPECT_FALSE(b.interrupt());
    EXPECT_EQ(b.status(X, 1), 1u);
    b.advance(milliseconds(1));
    wheel.turn(99, b.kernel.now());
    b.kernel.settle();
    EXPECT_TRUE(b.interrupt());
    EXPECT_EQ(b.status(X, 3), 0x0008u);
    wheel.turn(100, b.kernel.now());
    EXPECT_EQ(b.status(X, 3), 0x0010u);
    EXPECT_LE(wheel.crossings, 4);
}

TEST(ChipEncoder, ASoftwareLimitMayBeOfTheEncoder) {
    Bench b;
    HandWheel wheel;
    b.chip.connect_encoder(0, wheel);
    b.start();
    b.mode(X, 2, 0x0021);
    b.data(X, 0x0B, 10);
    b.speeds(X, 80'000, 1000, 1000);
    b.command(X, 0x22);
    b.advance(milliseconds(5));
    EXPECT_TRUE(b.read(0) & X);
    wheel.turn(11, b.kernel.now());
    b.advance(tick);
    EXPECT_FALSE(b.read(0) & X);
    EXPECT_TRUE(b.status(X, 2) & 1u);
}

TEST(ChipEncoder, WithoutAnEncoderTheLinesThemselvesCount) {
    Bench b;
    b.start();
    const int lines[][2] = {{0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}};  // A falls first: upwards
    for (const auto& line : lines) {
        b.wire("zeca", line[0]);
        b.wire("zecb", line[1]);
    }
    EXPECT_EQ(b.ep(Z), 5);
    b.wire("zeca", 1);
    EXPECT_EQ(b.ep(Z), 4);
    b.mode(Z, 2, 0x0200);  // up and down pulses
    for (int i = 0; i < 3; ++i) b.wire("zecb", 0), b.wire("zecb", 1);
    EXPECT_EQ(b.ep(Z), 1);
}

// ---- listeners

class Watcher final : public sim::PositionListener {
  public:
    explicit Watcher(sim::PositionFunction& motion) : motion_(motion), slot_(motion.add_listener(*this)) {}
    void watch(std::int64_t below, std::int64_t above) { motion_.watch(slot_, below, above); }
    void crossed(Instant now) override { crossings.push_back({now / tick, motion_.count(now)}); }
    void rate_changed(double before, double rate, Instant) override {
        EXPECT_EQ(before, reported);
        reported = rate;
        rates.push_back(rate);
    }
    double reported = 0;
    std::vector<std::pair<std::int64_t, std::int64_t>> crossings;
    std::vector<double> rates;

  private:
    sim::PositionFunction& motion_;
    int slot_;
};

TEST(ChipMotion, ALimitAtTheStartIsDetectedWhateverIsWatchedInItsFirstTicks) {
    for (int ticks = 0; ticks < 7; ++ticks) {
        Bench b;
        Watcher watcher(b.chip.pulses(1));
        b.start();
        b.speeds(X, 16'000, 1000, 1000);
        b.mode(X, 3, 0x0008);  // drives while nEXPP is Low
        b.wire("xlmtp", 0);
        b.advance(tick * 4);
        b.wire("xexpp", 0);
        b.advance(tick * ticks);
        watcher.watch(-10, 10);
        b.advance(tick * 30);
        EXPECT_EQ(b.read(0) & X, 0u) << ticks;
        EXPECT_EQ(b.count(0), 0) << ticks;
    }
}

TEST(ChipMotion, AWatchedCountIsReportedOnceAtItsTick) {
    Bench b;
    EdgeLog log;
    Watcher one(b.chip.pulses(0)), two(b.chip.pulses(0));
    b.start();
    b.chip.pulses(0).set_edge_listener(&log);
    one.watch(-5, 50);
    two.watch(-7, 200);
    b.speeds(X, 16'000, 100, 4000);
    b.data(X, 0x06, 100);
    b.command(X, 0x20);
    ASSERT_TRUE(b.finish(X));
    b.data(X, 0x06, 300);
    b.command(X, 0x21);
    ASSERT_TRUE(b.finish(X));
    b.advance(tick);
    ASSERT_EQ(one.crossings.size(), 1u);
    EXPECT_EQ(one.crossings[0], (std::pair<std::int64_t, std::int64_t>{log.list[49].tick, 50}));
    ASSERT_EQ(two.crossings.size(), 1u);
    EXPECT_EQ(two.crossings[0], (std::pair<std::int64_t, std::int64_t>{log.list[206].tick, -7}));
}

TEST(ChipMotion, AWatchedRangeThatIsAlreadyLeftIsReportedAtTheNextInstant) {
    Bench b;
    Watcher watcher(b.chip.pulses(2));
    b.start();
    b.advance(milliseconds(1));
    watcher.watch(-1, 0);
    EXPECT_TRUE(watcher.crossings.empty());
    b.advance(tick);
    EXPECT_EQ(watcher.crossings.size(), 1u);
    b.advance(milliseconds(1));
    EXPECT_EQ(watcher.crossings.size(), 1u);
}

TEST(ChipMotion, RatesAreReportedAtEveryStepOfTheSpeedAndOfEveryAxis) {
    Bench b;
    Watcher x(b.chip.pulses(0)), y(b.chip.pulses(1));
    b.start();
    b.write(5, 0x0024);
    b.speeds(X, 80'000, 100, 110);
    b.data(X, 0x06, 1000);
    b.data(Y, 0x06, -250);
    b.command(0, 0x30);
    ASSERT_TRUE(b.finish(X | Y));
    b.advance(tick);
    ASSERT_EQ(x.rates.size(), 12u);  // 11 rates, 100 to 110, then 0
    for (int i = 0; i <= 10; ++i) {
        EXPECT_DOUBLE_EQ(x.rates[static_cast<std::size_t>(i)], 100.0 * (100 + i));
        EXPECT_DOUBLE_EQ(y.rates[static_cast<std::size_t>(i)], -25.0 * (100 + i));
    }
    EXPECT_EQ(x.rates.back(), 0);
    EXPECT_EQ(b.chip.pulses(0).rate(b.kernel.now()), 0);
}

TEST(ChipState, EqualChipsHaveEqualBytesAndRestoredOnesEqualFutures) {
    const auto world = [](Bench& b) {
        b.start();
        b.write(5, 0x0024);
        b.speeds(X | Y, 16'000, 100, 4000);
        b.data(X, 0x08, 4000);
        b.data(Y, 0x08, 300);
        b.data(X | Y, 0x06, 0);
        b.command(0, 0x32);
        b.advance(milliseconds(3));
    };
    Bench one, two;
    world(one);
    world(two);
    EXPECT_EQ(one.kernel.state_hash(), two.kernel.state_hash());
    const sim::Snapshot snapshot = one.kernel.snapshot();
    one.advance(milliseconds(7));
    const std::uint64_t later = one.kernel.state_hash();
    one.kernel.restore(snapshot);
    EXPECT_EQ(one.kernel.state_hash(), two.kernel.state_hash());
    one.advance(milliseconds(7));
    EXPECT_EQ(one.kernel.state_hash(), later);
}

}  // namespace
}  // namespace motionrack::mcx314::outside
