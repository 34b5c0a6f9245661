// Tests of bit patterns through registers and pins: the maker's figure, the stack, late data, stops, registers.
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/cards/mcx314/map.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>

namespace motionrack::mcx314::outside {
namespace {

using Word = std::array<unsigned, 6>;  // BP1P, BP1M, BP2P, BP2M, BP3P, BP3M

// A chip whose X steps every 10 ticks in a bit pattern of X and Y (and Z).
class Patterns : public Bench {
  public:
    explicit Patterns(unsigned wr5 = 0x0024) {
        start();
        speeds(X | Y | Z, 20'000, 2000, 2000);
        write(5, wr5);
        command(0, cmd::BP_ENABLE);
    }
    void stack(const Word& word) {
        for (int i = 0; i < 6; ++i) write(2 + i, word[static_cast<std::size_t>(i)]);
        command(0, cmd::BP_STACK);
    }
    void go(unsigned code = cmd::BP2) { command(0, code); }
    unsigned stacked() { return field("RR0", "BPSC").get(read(0)); }
    bool runs() { return field("RR0", "IDRV").test(read(0)); }
    std::uint16_t last_condition() {
        const auto list = kernel.conditions();
        return list.empty() ? 0 : list.back().code;
    }
};

// The sample program of the maker's manual: 62 steps and an end code.
constexpr std::array<Word, 4> figure = {{{0x0000, 0x2BFF, 0xFFD4, 0x0000},
                                         {0xF6FE, 0x0000, 0x000F, 0x3FC0},
                                         {0x1FDB, 0x0000, 0x00FF, 0xFC00},
                                         {0x4000, 0x7FF5, 0x0000, 0x0AFF}}};

TEST(ChipPattern, TheDocumentedPatternIsClosedAndEndsWithItsEndCode) {
    Patterns b;
    for (int i = 0; i < 3; ++i) b.stack(figure[static_cast<std::size_t>(i)]);
    EXPECT_EQ(b.stacked(), 3u);
    b.go();
    EXPECT_EQ(b.stacked(), 2u) << "one runs";
    EXPECT_TRUE(b.runs());
    EXPECT_FALSE(field("RR0", "CNEXT").test(b.read(0)));
    b.stack(figure[3]);
    b.command(0, cmd::BP_DISABLE);
    const std::array<std::array<std::int64_t, 2>, 3> nodes = {{{-12, 12}, {1, 8}, {12, 10}}};
    for (std::size_t i = 0; i < 3; ++i) {
        b.advance(tick * (i == 0 ? 2 + 160 : 160));  // the first step comes ten ticks after the two of the command
        EXPECT_EQ(b.count(0), nodes[i][0]) << "word " << i;
        EXPECT_EQ(b.count(1), nodes[i][1]) << "word " << i;
        EXPECT_EQ(b.stacked(), 2u - i);
    }
    b.advance(tick * 149);
    EXPECT_TRUE(b.runs()) << "the end code has its own basic pulse";
    EXPECT_EQ(b.count(0), 0);
    EXPECT_EQ(b.count(1), 0);
    b.advance(tick);
    EXPECT_FALSE(b.runs());
    EXPECT_EQ(b.stacked(), 0u);
    EXPECT_EQ(b.lp(X), 0);
    EXPECT_EQ(b.lp(Y), 0);
    EXPECT_TRUE(b.kernel.conditions().empty());
}

TEST(ChipPattern, ACircleStackedOnTheInterruptKeepsItsRadius) {
    Patterns b(0x8004);  // BPINT
    // Steps of a circle of radius 100, from (100, 0) counter-clockwise, as a host computer would generate them.
    std::vector<std::array<int, 2>> steps;
    for (std::array<int, 2> at = {100, 0}, done = {0, 0}; steps.size() < 4 || at != std::array<int, 2>{100, 0};) {
        const double angle = std::atan2(at[1], at[0]) + 0.01;
        done = {static_cast<int>(std::lround(100 * std::cos(angle))),
                static_cast<int>(std::lround(100 * std::sin(angle)))};
        steps.push_back({done[0] - at[0], done[1] - at[1]});
        at = done;
    }
    std::size_t next = 0;
    auto word = [&] {
        Word out{};
        for (unsigned k = 0; k < 16; ++k, ++next) {
            if (next >= steps.size()) {
                out[0] |= 1u << k, out[1] |= 1u << k;
                continue;
            }
            for (unsigned i = 0; i < 2; ++i) {
                if (steps[next][i] > 0) out[2 * i] |= 1u << k;
                if (steps[next][i] < 0) out[2 * i + 1] |= 1u << k;
            }
        }
        return out;
    };
    for (int i = 0; i < 3; ++i) b.stack(word());
    b.go();
    EdgeLog x, y;
    b.chip.pulses(0).set_edge_listener(&x);
    b.chip.pulses(1).set_edge_listener(&y);
    int interrupts = 0;
    while (b.runs()) {
        if (b.wait(milliseconds(1)) && ++interrupts > 0) b.stack(word());
        EXPECT_FALSE(b.interrupt()) << "stacking clears it";
        ASSERT_LT(interrupts, 100);
        const double radius = std::hypot(static_cast<double>(100 + b.count(0)), static_cast<double>(b.count(1)));
        EXPECT_NEAR(radius, 100, 1);
    }
    EXPECT_GT(interrupts, 30);
    EXPECT_EQ(b.count(0), 0);
    EXPECT_EQ(b.count(1), 0);
    EXPECT_TRUE(b.kernel.conditions().empty());
    EXPECT_GT(x.list.size(), 380u);
    EXPECT_GT(y.list.size(), 380u);
}

TEST(ChipPattern, TheStackHoldsThreeWordsAndAFourthIsIgnored) {
    Patterns b(0x8004);
    for (unsigned i = 0; i < 3; ++i) {
        EXPECT_EQ(b.stacked(), i);
        b.stack({0xFFFF});
    }
    EXPECT_TRUE(b.kernel.conditions().empty());
    b.stack({0, 0xFFFF});
    EXPECT_EQ(b.stacked(), 3u);
    EXPECT_EQ(b.last_condition(), pattern_full);
    b.go();
    EXPECT_EQ(b.stacked(), 2u);
    EXPECT_FALSE(b.interrupt()) << "3 to 2";
    b.advance(tick * 162);
    EXPECT_EQ(b.stacked(), 1u);
    EXPECT_TRUE(b.interrupt()) << "2 to 1";
    b.command(0, cmd::INTERPOLATION_INTERRUPT_CLEAR);
    b.kernel.settle();
    EXPECT_FALSE(b.interrupt());
    b.command(0, cmd::BP_CLEAR);
    EXPECT_EQ(b.stacked(), 0u);
    b.advance(tick);
    EXPECT_FALSE(b.runs()) << "nothing is left to run";
    EXPECT_EQ(b.count(0), 16);
}

TEST(ChipPattern, LateDataEndTheDriveWithNothingLatched) {
    Patterns b;
    b.command(0, cmd::BP_DISABLE);
    b.mode(X, 1, 0x8000);  // D-END
    b.command(0, cmd::BP_ENABLE);
    b.stack({0xFFFF, 0, 0x00FF, 0xFF00});
    b.go();
    b.advance(tick * 161);
    EXPECT_TRUE(b.runs());
    b.advance(tick);
    EXPECT_FALSE(b.runs());
    EXPECT_EQ(b.count(0), 16);
    EXPECT_EQ(b.count(1), 0);
    EXPECT_EQ(b.status(X, 1) & 0xFF00u, 0u);
    EXPECT_TRUE(field("RR3", "DEND").test(b.status(X, 3)));
    ASSERT_EQ(b.last_condition(), pattern_ran_out);
    EXPECT_EQ(b.kernel.conditions().back().a, 16);
    b.go();
    b.advance(tick * 3);
    EXPECT_FALSE(b.runs()) << "without data it ends at its first working tick";
    EXPECT_EQ(b.count(0), 16);
}

TEST(ChipPattern, AStopKeepsTheRemainingBitsOfTheWord) {
    Patterns b;
    b.stack({0xFFFF, 0, 0x5555, 0xAAAA});
    b.stack({0xC003, 0xC000});
    b.go();
    b.advance(tick * 52);
    EXPECT_EQ(b.count(0), 5);
    b.command(Y, cmd::QUICK_STOP);
    b.advance(tick * 100);
    EXPECT_FALSE(b.runs());
    EXPECT_EQ(b.count(0), 5);
    EXPECT_EQ(b.count(1), 1);
    EXPECT_EQ(b.stacked(), 1u);
    b.go();
    b.advance(tick * 112);
    EXPECT_EQ(b.count(0), 16) << "the rest of the word";
    EXPECT_EQ(b.count(1), 0);
    b.advance(tick * 200);
    EXPECT_EQ(b.count(0), 18);
    EXPECT_FALSE(b.runs());
    EXPECT_TRUE(b.kernel.conditions().empty());
}

TEST(ChipPattern, TheRegistersStandWhereTheModesWereOnlyWhileEnabled) {
    Patterns b;
    b.command(X, cmd::NOP);
    b.write(1, 0x8000);
    for (int n = 2; n <= 7; ++n) b.write(n, 0xFFFF);  // without BP_ENABLE: alarms, S-curves and outputs
    EXPECT_EQ(b.level("xout0"), 0);
    b.command(X, cmd::V);  // WR6 still has its value from before 36h: the 0 of AO
    b.command(0, cmd::BP_DISABLE);
    EXPECT_EQ(b.status(X, 2), 0u);
    b.write(4, 0x0001);
    b.kernel.settle();
    EXPECT_EQ(b.level("xout0"), 1);
    b.command(0, cmd::BP_STACK);  // the pattern registers keep the written values
    EXPECT_EQ(b.stacked(), 1u);
    b.data(X, cmd::V, 2000);
    b.go();
    b.advance(tick * 12);
    EXPECT_FALSE(b.runs()) << "all ones is the end code";
    EXPECT_TRUE(field("RR3", "DEND").test(b.status(X, 3))) << "WR1 could be written all the time";
}

TEST(ChipPattern, ALimitInTheDirectionOfTheNextStepStops) {
    Patterns b;
    b.stack({0x00FF, 0xFF00});
    b.go();
    b.wire("xlmtm", 0);
    b.advance(tick * 81);
    EXPECT_EQ(b.count(0), 7);
    EXPECT_TRUE(b.runs()) << "the axis goes away from it";
    b.advance(tick * 2);
    EXPECT_FALSE(b.runs());
    EXPECT_EQ(b.count(0), 8);
    EXPECT_TRUE(field("RR1", "LMTM").test(b.status(X, 1)));
}

TEST(ChipPattern, ConstantVectorSpeedLengthensPulsePeriodsOfTwoAxes) {
    Patterns b(0x0104);
    b.command(0, cmd::BP_DISABLE);
    b.data(Y, cmd::R, 28'000);
    b.command(0, cmd::BP_ENABLE);
    b.stack({0x8F0F, 0x8000, 0x8F33, 0x0000});
    EdgeLog x, y;
    b.chip.pulses(0).set_edge_listener(&x);
    b.chip.pulses(1).set_edge_listener(&y);
    b.go();
    b.advance(tick * 400);
    std::vector<std::int64_t> at;
    for (const auto& edge : x.list) at.push_back(edge.tick);
    // R after a basic pulse depends on the number of axes that it stepped: two with D0, D1 and from D8 on, one with D2
    // to D5, none with D6 and D7.
    EXPECT_EQ(at, (std::vector<std::int64_t>{12, 26, 40, 50, 100, 114, 128, 142}));
}

TEST(ChipPattern, ItDeceleratesFromTheManualPoint) {
    Patterns b;
    b.command(0, cmd::BP_DISABLE);
    b.speeds(X, 20'000, 1990, 2000, 8000);
    b.data(X, cmd::DP, 40);
    b.mode(X, 3, 0x0001);
    b.command(0, cmd::DECELERATION_ON);
    b.command(0, cmd::BP_ENABLE);
    for (int i = 0; i < 3; ++i) b.stack({0xFFFF});
    b.go();
    while (b.count(0) < 39) b.advance(tick);
    EXPECT_EQ(b.cv(X), 2000);
    while (b.count(0) < 47) b.advance(tick);
    EXPECT_LT(b.cv(X), 2000);
    EXPECT_TRUE(field("RR1", "DSND").test(b.status(X, 1)));
}

TEST(ChipPattern, IsNeitherQueuedNorFollowedByAQueuedSegment) {
    Patterns b;
    b.stack({0xFFFF});
    b.go();
    b.command(0, cmd::LINE2);
    EXPECT_EQ(b.last_condition(), path_ignored);
    b.command(0, cmd::BP2);
    EXPECT_EQ(b.kernel.conditions().size(), 2u);
    b.advance(tick * 300);
    b.command(0, cmd::BP_DISABLE);
    b.data(X, cmd::P, 100);
    b.command(0, cmd::LINE2);
    b.command(0, cmd::BP3);
    EXPECT_EQ(b.last_condition(), path_ignored);
    b.advance(tick * 2000);
    EXPECT_EQ(b.count(0), 116);
}

TEST(ChipPattern, ThreeAxesStepAtOnce) {
    Patterns b;
    b.stack({0x00FF, 0xFF00, 0xFFFF, 0x0000, 0x0000, 0x0FF0});
    b.go(cmd::BP3);
    b.advance(tick * 200);
    EXPECT_EQ(b.count(0), 0);
    EXPECT_EQ(b.count(1), 16);
    EXPECT_EQ(b.count(2), -8);
}

}  // namespace
}  // namespace motionrack::mcx314::outside
