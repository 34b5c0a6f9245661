// The card from outside: ports, wires, time, as described by the maker.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/databoard4002/test/host.hpp>
#include <motionrack/sim/test/fake_pulses.hpp>

namespace motionrack::databoard4002 {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Databoard4002, TheFunctionTestOfTheDescriptionPasses) {
    Host host;
    host.start();
    EXPECT_EQ(host.status(), stat::READY);
    EXPECT_EQ(host.events(0), 0x80);
    host.out(ports::C2, 0x57);
    EXPECT_EQ(host.events(0), 0x00);
    EXPECT_THAT(host.conditions(), IsEmpty());
}

TEST(Databoard4002, ReadyIsLowWhileTheFirmwareIsBusyAndAnAccessMeanwhileIsLost) {
    Host host;
    host.start();
    host.port.out(ports::C2, 'O');
    EXPECT_FALSE(host.status() & stat::READY);
    host.run(microseconds(50));
    host.port.out(ports::C2, 'M');
    EXPECT_THAT(host.conditions(), ElementsAre(CardCondition::access_lost));
    host.run(microseconds(49));
    EXPECT_FALSE(host.status() & stat::READY);
    host.run(microseconds(1));
    EXPECT_TRUE(host.status() & stat::READY);
    EXPECT_EQ(host.level("relay"), 1) << "O has set the rate, M was lost";
}

TEST(Databoard4002, TheFirstAccessAfterACommandSelectsReadingOrWriting) {
    Host host;
    host.start();
    host.command('P', 300, 3);
    host.command('R', 16'344, 2);
    host.command('G');
    host.run(milliseconds(100));
    EXPECT_EQ(host.ask('P', 3), 300);
    EXPECT_EQ(host.ask('D', 3), 0);
    EXPECT_EQ(host.ask('V', 1), 0x20);
    host.command('N', -310, 3);
    host.command('G');
    host.run(milliseconds(10));
    EXPECT_EQ(host.ask('R', 2), -16'344);
    host.run(milliseconds(100));
    EXPECT_EQ(host.ask('P', 3), -10);
    EXPECT_EQ(host.ask('R', 2), 0);
}

TEST(Databoard4002, RelativeMovesStartAtThePositionOfTheAxisAtG) {
    Host host;
    host.start();
    host.command('R', 16'344, 2);
    host.command('N', 100, 3);
    host.command('G');
    host.run(milliseconds(50));
    host.command('G');
    host.run(milliseconds(50));
    EXPECT_EQ(host.card.position(), 200);
}

TEST(Databoard4002, NothingMovesBeforeG) {
    Host host;
    host.start();
    host.demo_table(1);
    host.command('P', 1'000, 3);
    host.command('D', 0, 3);
    host.command('L');
    host.run(whole_seconds(1));
    EXPECT_EQ(host.card.position(), 0);
    EXPECT_EQ(host.level("vout"), 0);
}

TEST(Databoard4002, ARateOfZeroReleasesTheRelayAndTheNextOneContinues) {
    Host host;
    host.start();
    EXPECT_EQ(host.level("relay"), 0);
    host.command('R', 16'021, 2);
    host.run(microseconds(200));
    EXPECT_EQ(host.level("relay"), 1);
    EXPECT_EQ(host.level("vout"), 0);
    host.command('P', -100'000, 3);
    host.command('G');
    host.run(milliseconds(100));
    EXPECT_EQ(host.level("vout"), -1'000'000);
    EXPECT_EQ(host.level("sign"), 0);
    EXPECT_NEAR(host.card.fout_hz(), 400'000.0 / 363, 1e-9);
    host.command('R', 0, 2);
    host.run(microseconds(200));
    const std::int64_t there = host.card.position();
    EXPECT_EQ(host.level("relay"), 0);
    EXPECT_EQ(host.level("vout"), 0);
    host.run(milliseconds(100));
    EXPECT_EQ(host.card.position(), there);
    host.command('R', 16'021, 2);
    host.run(milliseconds(100));
    EXPECT_LT(host.card.position(), there);
}

TEST(Databoard4002, FourteenBitsOfTheRateCount) {
    Host host;
    host.start();
    host.command('R', 0xC000 | 16'021, 2);
    host.command('N', 1'000, 3);
    host.command('G');
    host.run(milliseconds(10));
    EXPECT_EQ(host.card.output_rate(), 16'021);
}

TEST(Databoard4002, AMoveLongerThan23BitsIsRefusedAndNotWrapped) {
    Host host;
    host.start();
    host.command('R', 16'344, 2);
    host.command('P', 10, 3);
    host.command('G');
    host.run(milliseconds(10));
    host.command('P', -8'388'600, 3);
    host.command('G');
    host.run(milliseconds(10));
    EXPECT_THAT(host.conditions(), ElementsAre(CardCondition::move_refused));
    EXPECT_EQ(host.card.position(), 10);
    host.command('N', 8'388'607, 3);
    host.command('G');
    host.run(milliseconds(10));
    EXPECT_EQ(host.card.position(), 10);
    EXPECT_EQ(host.conditions().size(), 2u);
}

// ---- resets

TEST(Databoard4002, AHangIsEndedByTheWatchdogAfterASecond) {
    Host host;
    host.start();
    host.command('W');
    host.command('R', 16'021, 2);
    host.command('N', 1'000'000, 3);
    host.command('G');
    host.run(milliseconds(10));
    ASSERT_TRUE(host.card.fault("watchdog.hang", 1, host.kernel.now()));
    host.port.out(ports::C2, 'Q');
    EXPECT_FALSE(host.wait_ready(milliseconds(900)));
    EXPECT_EQ(host.level("vout"), 1'000'000) << "the divider runs on";
    host.run(milliseconds(100));
    EXPECT_EQ(host.level("vout"), 0);
    EXPECT_EQ(host.level("relay"), 0);
    EXPECT_TRUE(host.status() & stat::READY);
    EXPECT_EQ(host.events(0), 0x80);
    EXPECT_EQ(host.card.position(), 0);
    EXPECT_THAT(host.conditions(), Contains(CardCondition::watchdog_reset));
}

TEST(Databoard4002, C3ResetsThisCardAtOnceAndPulsesRst) {
    Host host;
    host.start();
    host.command('R', 16'021, 2);
    host.command('N', 1'000'000, 3);
    host.command('G');
    host.run(milliseconds(10));
    host.port.out(ports::C3, 0);
    EXPECT_EQ(host.level("vout"), 0);
    EXPECT_EQ(host.status(), stat::READY);
    EXPECT_EQ(host.level("rst"), 1);
    host.run(microseconds(10));
    EXPECT_EQ(host.level("rst"), 0);
    EXPECT_EQ(host.events(0), 0x80);
}

// ---- several cards

TEST(Databoard4002Bus, OnlyTheSelectedCardRespondsAndInp7ResetsAllCards) {
    Host host;
    Card other(host.kernel, "c2");
    other.connect_encoder(other.pulses());
    host.bus.plug(other, 14);
    host.start();
    host.command('R', 16'344, 2);
    host.wait_ready();
    host.port.out(ports::CS, 14);
    EXPECT_EQ(other.peek(ports::STAT), stat::READY);
    host.command('R', 16'021, 2);
    host.command('N', 100'000, 3);
    host.command('G');
    host.run(milliseconds(20));
    EXPECT_TRUE(other.moving());
    EXPECT_FALSE(host.card.moving());
    EXPECT_EQ(host.level("relay"), 1);
    host.port.out(ports::CS, 99);
    EXPECT_EQ(host.status(), 0xFF) << "nobody answers";
    host.port.out(ports::C3, 0);
    EXPECT_TRUE(other.moving()) << "nobody listens";
    EXPECT_EQ(host.port.in(ports::RST), 0xFF);
    EXPECT_FALSE(other.moving());
    EXPECT_EQ(host.level("relay"), 0);
}

TEST(Databoard4002Bus, AnyCardsInterruptReachesTheHost) {
    Host host;
    Card other(host.kernel, "c2");
    host.bus.plug(other, 14);
    host.start();
    host.port.out(ports::CS, 14);
    host.out(ports::C4, event::ON_EVENT | event::STOP);
    host.wait_ready();
    host.port.out(ports::CS, select);
    host.kernel.set_wire(host.kernel.find_wire("c2.esl"), 1);
    EXPECT_TRUE(host.port.wait(milliseconds(1)));
    EXPECT_FALSE(host.status() & stat::INT) << "not of this card";
}

// ---- counting

TEST(Databoard4002, LinesDrivenAsWiresAreCountedByTheirStraps) {
    for (const auto& [folding, expected] :
         {std::pair{sim::Edges::all, 12}, {sim::Edges::both_of_a, 6}, {sim::Edges::rising_a, 3}}) {
        Settings settings;
        settings.folding = folding;
        Host host(settings, false);
        host.start();
        for (int count = 1; count <= 12; ++count) {
            host.set("o1", sim::lines_of(count) & 1);
            host.set("o2", sim::lines_of(count) >> 1);
            host.run(microseconds(10));
        }
        EXPECT_EQ(host.card.position(), expected);
    }
    Settings settings;
    settings.counting = Counting::up_down;
    Host host(settings, false);
    host.start();
    for (const char* pin : {"o2", "o2", "o2", "o1"})
        for (const int level : {1, 0}) {
            host.set(pin, level);
            host.run(microseconds(10));
        }
    EXPECT_EQ(host.card.position(), 2);
}

TEST(Databoard4002, AnEncoderAboveItsMaximumRateLosesCountsAndReportsIt) {
    sim::Kernel kernel;
    sim::FakePulses encoder(kernel, {});
    Host host({}, false, &encoder, &kernel);
    host.start();
    encoder.drive(nanoseconds(2'500), 1);  // 400,000 counts/s: 100 kHz per line
    host.run(milliseconds(1));
    EXPECT_EQ(host.card.position(), 400);
    encoder.drive(nanoseconds(2'000), 1);
    host.run(milliseconds(1));
    EXPECT_EQ(host.card.position(), 400);
    encoder.drive(nanoseconds(5'000), -1);
    host.run(milliseconds(1));
    EXPECT_EQ(host.card.position(), 200);
    EXPECT_THAT(host.conditions(), ElementsAre(CardCondition::rate_exceeded, CardCondition::counts_lost));
    EXPECT_EQ(kernel.conditions()[1].a, 500);
}

TEST(Databoard4002, ALineAboveItsMaximumRateLosesCountsAndReportsIt) {
    Host host({}, false);
    host.start();
    host.set("o1", 1);
    host.run(microseconds(1));
    host.set("o1", 0);
    host.run(microseconds(1));
    host.set("o1", 1);
    host.run(microseconds(10));
    EXPECT_EQ(host.card.position(), 1);
    EXPECT_THAT(host.conditions(), ElementsAre(CardCondition::line_too_quick));
}

TEST(Databoard4002, ADisconnectedEncoderKeepsItsCountAndTheWiresContinueIt) {
    Host host;
    host.start();
    host.command('R', 16'344, 2);
    host.command('N', 102, 3);
    host.command('G');
    host.run(milliseconds(50));
    const sim::WireId o1 = host.kernel.find_wire("c1.o1"), o2 = host.kernel.find_wire("c1.o2");
    host.card.take_encoder(true);
    host.kernel.settle();
    EXPECT_EQ(host.card.position(), 102);
    for (int count = 103; count <= 105; ++count) {
        host.kernel.force(o1, sim::lines_of(count) & 1);
        host.kernel.force(o2, sim::lines_of(count) >> 1);
        host.run(microseconds(10));
    }
    EXPECT_EQ(host.card.position(), 105);
    host.card.take_encoder(false);
    host.kernel.settle();
    host.command('N', 5, 3);
    host.command('G');
    host.run(milliseconds(50));
    EXPECT_EQ(host.card.position(), 110);
}

TEST(Databoard4002, EveryConditionHasASentence) {
    for (int code = 1; code <= static_cast<int>(CardCondition::watchdog_reset); ++code) {
        const std::string text = describe({milliseconds(12), {}, static_cast<std::uint16_t>(code), 3, 2}, "c1");
        EXPECT_EQ(text.find("card c1: at 0.012000 s "), 0u) << text;
        EXPECT_EQ(text.find("condition"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace motionrack::databoard4002
