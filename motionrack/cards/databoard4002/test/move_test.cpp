// Moves by the slope table, lock, and the demonstration program of the description.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <motionrack/cards/databoard4002/test/host.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>

namespace motionrack::databoard4002 {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Consecutive rates of the output until the card is stationary.
std::vector<int> rates_of_move(Host& host) {
    std::vector<int> out;
    host.wait_ready();
    while (host.card.moving()) {
        const int rate = host.card.output_rate();
        if (out.empty() || out.back() != rate) out.push_back(rate);
        host.run(microseconds(100));
    }
    return out;
}

void demo_go(Host& host, int position) {
    host.command('P', 256 * position, 3);
    host.out(ports::C4, 1 + 32);
    host.in(ports::DATA);
    host.command('G');
    ASSERT_TRUE(host.wait_event(whole_seconds(200)));
    host.out(ports::C4, 1 + 32);
    EXPECT_TRUE(host.in(ports::DATA)&1);
}

TEST(Databoard4002Moves, TheDemonstrationProgramRunsItsRounds) {
    Host host;
    host.start();
    host.out(ports::C2, 'I');
    host.command('D', 25, 3);
    for (int round = 0; round < 2; ++round) {
        host.command('R', 63 * 256 + 240, 2);
        host.demo_table(1);
        const Instant a = host.kernel.now();
        demo_go(host, 1000);
        const Instant c = host.kernel.now();
        EXPECT_EQ(host.card.position(), 256'000);
        host.command('L');
        host.run(whole_seconds(1));
        EXPECT_EQ(host.card.position(), 256'000);
        host.command('M');
        host.demo_table(2);
        host.command('R', 63 * 256 + 240, 2);
        demo_go(host, 500);
        EXPECT_EQ(host.card.position(), 128'000);
        host.command('R', 63 * 256, 2);
        const Instant b = host.kernel.now();
        demo_go(host, 0);
        EXPECT_EQ(host.card.position(), 0);
        EXPECT_GT(host.kernel.now() - b, c - a) << "half the way at limited speed takes longer";
    }
    EXPECT_THAT(host.conditions(), IsEmpty());
}

TEST(Databoard4002Moves, RateIsTheMinimumOfAccelerationDecelerationAndRate) {
    Host host;
    host.start();
    host.demo_table(1);
    host.command('P', 256 * 1000, 3);
    host.command('G');
    std::vector<int> expected;
    for (const auto& row : demo_acceleration) expected.push_back(row[0]);
    for (int i = 22; i >= 0; --i) expected.push_back(demo_deceleration[i][0]);
    EXPECT_EQ(rates_of_move(host), expected);
    EXPECT_EQ(host.card.position(), 256'000);
    // Limited: no higher rate, and the same path back.
    host.command('R', 16'310, 2);
    host.command('P', 0, 3);
    host.command('G');
    std::vector<int> limited;
    for (const int rate : expected)
        if (limited.empty() || limited.back() != -std::min(rate, 16'310)) limited.push_back(-std::min(rate, 16'310));
    EXPECT_EQ(rates_of_move(host), limited);
}

TEST(Databoard4002Moves, AShortMoveChangesFromAccelerationToDecelerationInTheMiddle) {
    Host host;
    host.start();
    host.demo_table(1);
    host.command('P', 256 * 20, 3);
    host.command('G');
    EXPECT_THAT(rates_of_move(host), ElementsAre(14'000, 14'500, 15'002, 14'500, 14'000));
}

TEST(Databoard4002Moves, ALongMoveCostsItsSlopeStepsNotItsCounts) {
    Host host;
    host.start();
    host.demo_table(1);
    const std::uint64_t before = host.kernel.events();
    host.command('P', 8'000'000, 3);
    host.command('G');
    host.run(whole_seconds(1'000));
    EXPECT_EQ(host.card.position(), 8'000'000);
    EXPECT_LT(host.kernel.events() - before, 400u);
}

/// A single rate, independent of the card's position.
void flat_table(Host& host, int rate) {
    host.command('S');
    for (int i = 0; i < 48; ++i) {
        host.number(rate, 2);
        host.number(0, 3);
    }
}

TEST(Databoard4002Moves, TheRunningMoveKeepsItsTargetAndTable) {
    Host host;
    host.start();
    host.demo_table(1);
    host.command('P', 256 * 1000, 3);
    host.command('G');
    host.command('P', 5, 3);
    flat_table(host, 15'000);
    EXPECT_THAT(host.conditions(), ElementsAre(CardCondition::during_move, CardCondition::during_move));
    ASSERT_LT(host.card.position(), 256 * 500);
    std::vector<int> expected;
    for (const auto& row : demo_acceleration) expected.push_back(row[0]);
    for (int i = 22; i >= 0; --i) expected.push_back(demo_deceleration[i][0]);
    const std::vector<int> rates = rates_of_move(host);
    ASSERT_FALSE(rates.empty());
    expected.erase(expected.begin(), std::find(expected.begin(), expected.end(), rates.front()));
    EXPECT_EQ(rates, expected);
    EXPECT_GT(rates.size(), 23u);
    EXPECT_EQ(host.card.position(), 256'000);
    // The next one uses the target and the table written in the meantime.
    host.command('G');
    EXPECT_THAT(rates_of_move(host), ElementsAre(-15'000));
    EXPECT_EQ(host.card.position(), 5);
}

TEST(Databoard4002Moves, ATableCutShortIsReported) {
    Host host;
    host.start();
    host.command('S');
    host.number(0, 6);
    host.command('Q');
    host.wait_ready();
    EXPECT_THAT(host.conditions(), ElementsAre(CardCondition::arguments_dropped));
}

TEST(Databoard4002Moves, ATableOfZerosIsReportedAndDoesNotMove) {
    Host host;
    host.start();
    host.command('O');
    host.command('P', 1'000, 3);
    host.command('G');
    host.run(whole_seconds(1));
    EXPECT_THAT(host.conditions(), ElementsAre(CardCondition::table_flawed));
    EXPECT_EQ(host.card.position(), 0);
    EXPECT_TRUE(host.status() & stat::READY);
    host.command('Q');
    host.run(milliseconds(1));
    EXPECT_FALSE(host.card.moving());
}

/// A move to 10,000 that is ended by Q near 1,000.
void quit_on_the_way(Host& host) {
    host.start();
    host.command('R', 16'344, 2);
    host.command('P', 10'000, 3);
    host.command('G');
    host.run(milliseconds(100));
    host.command('Q');
    host.run(milliseconds(100));
    EXPECT_GT(host.card.position(), 900);
    EXPECT_LT(host.card.position(), 1'100);
    EXPECT_EQ(host.level("relay"), 1) << "Rate stays";
}

TEST(Databoard4002Moves, QuitStopsZeroesThePositionRegisterAndKeepsRate) {
    Host host;
    quit_on_the_way(host);
    host.command('G');
    host.run(whole_seconds(1));
    EXPECT_EQ(host.card.position(), 0) << "the register is zeroed: G goes to 0";
    host.command('N', 50, 3);
    host.command('Q');
    host.command('G');
    host.run(milliseconds(100));
    EXPECT_EQ(host.card.position(), 0) << "so is the distance";
}

TEST(Databoard4002Moves, QuitKeepsTheTargetWhereItIsSetSo) {
    Settings settings;
    settings.quit_zeroes = false;
    Host host(settings);
    quit_on_the_way(host);
    host.command('G');
    host.run(whole_seconds(1));
    EXPECT_EQ(host.card.position(), 10'000);
}

TEST(Databoard4002Moves, AthomeMakesThePresentPositionZero) {
    Host host;
    host.start();
    host.command('R', 16'344, 2);
    host.command('N', 77, 3);
    host.command('G');
    host.run(milliseconds(50));
    host.command('A');
    EXPECT_EQ(host.ask('P', 3), 0);
    EXPECT_EQ(host.ask('D', 3), 0);
}

TEST(Databoard4002Moves, LockReturnsToItsTargetAfterAPushBeyondItsWindow) {
    sim::Kernel kernel;
    sim::FakePulses hand(kernel, {});
    Host host({}, false, &hand, &kernel);
    host.start();
    host.command('R', 16'344, 2);
    host.command('P', 0, 3);
    host.command('G');
    host.command('D', 25, 3);
    host.command('L');
    host.run(milliseconds(1));
    hand.drive(microseconds(100), 1);
    host.run(microseconds(2'500));
    EXPECT_EQ(host.card.position(), 25);
    EXPECT_EQ(host.level("vout"), 0);
    host.run(microseconds(100));
    EXPECT_LT(host.level("vout"), 0);
    EXPECT_EQ(host.ask('D', 3), 27) << "pushed on while the host asks";
    hand.drive(microseconds(100), -1);
    host.run(microseconds(100) * host.card.position());
    EXPECT_EQ(host.card.position(), 0);
    EXPECT_EQ(host.level("vout"), 0);
    hand.drive(microseconds(100), 0);
    EXPECT_TRUE(host.card.locked());
    host.command('M');
    host.run(milliseconds(100));
    hand.drive(microseconds(100), 1);
    host.run(milliseconds(100));
    EXPECT_EQ(host.level("vout"), 0) << "lock is off";
}

}  // namespace
}  // namespace motionrack::databoard4002
