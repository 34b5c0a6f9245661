// Stops, events and interrupts of the card, from outside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/databoard4002/test/host.hpp>

namespace motionrack::databoard4002 {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

// ---- stops

TEST(Databoard4002, AnEndStopBlocksItsDirectionInHardwareAndNotTheOther) {
    Host host;
    host.start();
    host.out(ports::C4, 0x21);
    host.command('R', 16'344, 2);
    host.command('P', 100'000, 3);
    host.command('G');
    host.run(milliseconds(50));
    EXPECT_GT(host.level("vout"), 0);
    host.set("esr", 1);
    EXPECT_EQ(host.level("vout"), 0) << "at once, without the firmware";
    EXPECT_EQ(host.level("relay"), 1);
    const std::int64_t there = host.card.position();
    host.run(milliseconds(50));
    EXPECT_EQ(host.card.position(), there);
    EXPECT_TRUE(host.status() & stat::EVENT);
    EXPECT_TRUE(host.status() & stat::ESR);
    EXPECT_EQ(host.events(0x21), 0xA0);
    EXPECT_FALSE(host.status() & stat::EVENT) << "the stop is still active, but the event is its edge";
    host.command('P', 0, 3);
    host.command('G');
    host.run(milliseconds(1));
    EXPECT_LT(host.level("vout"), 0);
    host.run(milliseconds(100));
    EXPECT_EQ(host.card.position(), 0);
    EXPECT_TRUE(host.events(0x21) & event::POSITION);
}

TEST(Databoard4002, TheEmergencyStopDropsTheRelayEndsTheMoveAndNothingRestarts) {
    Host host;
    host.start();
    host.out(ports::C4, 0x21);
    host.command('R', 16'344, 2);
    host.command('P', 100'000, 3);
    host.command('G');
    host.run(milliseconds(50));
    host.set("ems", 1);
    EXPECT_EQ(host.level("relay"), 0);
    EXPECT_EQ(host.level("vout"), 0);
    host.run(milliseconds(10));
    EXPECT_FALSE(host.card.moving());
    EXPECT_THAT(host.conditions(), ElementsAre(CardCondition::move_aborted));
    EXPECT_EQ(host.events(0x21), 0xA0);
    host.command('G');
    host.run(milliseconds(1));
    EXPECT_THAT(host.conditions(), Contains(CardCondition::go_in_emergency));
    host.set("ems", 0);
    const std::int64_t there = host.card.position();
    host.run(milliseconds(50));
    EXPECT_EQ(host.level("relay"), 1) << "the rate is still set";
    EXPECT_EQ(host.level("vout"), 0);
    EXPECT_EQ(host.card.position(), there);
}

TEST(Databoard4002, ABrokenWireIsAStop) {
    Host host;
    host.start();
    host.command('R', 16'344, 2);
    host.run(milliseconds(1));
    EXPECT_TRUE(host.card.fault("ems.broken", 1, host.kernel.now()));
    EXPECT_TRUE(host.status() & stat::EMS);
    EXPECT_EQ(host.level("relay"), 0);
    EXPECT_TRUE(host.card.fault("ems.broken", 0, host.kernel.now()));
    EXPECT_FALSE(host.status() & stat::EMS);
    EXPECT_FALSE(host.card.fault("fuse", 1, host.kernel.now()));
}

TEST(Databoard4002, TheEmergencyStopDoesNotActOnTheOutputInFrontOfTheRelay) {
    Host host;
    host.start();
    host.command('R', 16'344, 2);
    host.command('P', 100'000, 3);
    host.command('G');
    host.run(milliseconds(50));
    const int volts = host.level("vout");
    EXPECT_GT(volts, 0);
    EXPECT_EQ(host.level("vdirect"), volts);
    host.command('P', -100'000, 3);
    host.command('G');
    host.run(milliseconds(5));
    EXPECT_EQ(host.level("vdirect"), -volts);
    EXPECT_TRUE(host.card.fault("watchdog.hang", 1, host.kernel.now()));
    host.set("ems", 1);
    EXPECT_EQ(host.level("relay"), 0);
    EXPECT_EQ(host.level("vout"), 0);
    EXPECT_EQ(host.level("vdirect"), -volts) << "the card's program, which would end the move, hangs";
    EXPECT_TRUE(host.card.fault("watchdog.hang", 0, host.kernel.now()));
    host.run(milliseconds(10));
    EXPECT_EQ(host.level("vdirect"), 0);
}

TEST(Databoard4002, CsbIsHighOnTheSelectedCardOnly) {
    Host host;
    Card other(host.kernel, "c2", {});
    host.bus.plug(other, 14);
    host.start();
    const auto shown = [&] { return std::pair(host.level("csb"), host.kernel.level(host.kernel.find_wire("c2.csb"))); };
    EXPECT_EQ(shown(), std::pair(1, 0));
    host.port.out(ports::CS, 14);
    EXPECT_EQ(shown(), std::pair(0, 1));
    host.port.out(ports::CS, 3);
    EXPECT_EQ(shown(), std::pair(0, 0));
}

// ---- events

TEST(Databoard4002, ADisabledEventDoesNotOccurAndALatchedOneStaysUntilC4) {
    Host host;
    host.start();
    host.command('W');
    host.command('R', 16'344, 2);
    host.command('N', 50, 3);
    host.command('G');
    host.run(milliseconds(50));
    EXPECT_FALSE(host.status() & stat::EVENT);
    host.set("esr", 1);
    host.set("esr", 0);
    EXPECT_EQ(host.events(0x21), 0);
    EXPECT_FALSE(host.status() & stat::EVENT) << "what happened before it was enabled is over";
    host.command('G');
    ASSERT_TRUE(host.wait_event(milliseconds(50)));
    host.set("esl", 1);
    host.run(milliseconds(1));
    EXPECT_EQ(host.events(0x21), event::POSITION) << "latched before the stop";
    EXPECT_TRUE(host.status() & stat::EVENT) << "the stop came while the word was latched and is not lost";
    EXPECT_EQ(host.events(0x21), event::STOP);
    EXPECT_FALSE(host.status() & stat::EVENT);
}

TEST(Databoard4002, GoClearsPositionReached) {
    Host host;
    host.start();
    host.command('R', 16'344, 2);
    host.command('N', 50, 3);
    host.command('G');
    host.run(milliseconds(50));
    host.command('N', 5'000, 3);
    host.command('G');
    host.run(milliseconds(1));
    EXPECT_EQ(host.events(0), 0x80);
}

TEST(Databoard4002, ZeroAndReferenceTogetherAreOneEventAndZeroTheCounterAtThatInstant) {
    Host host;
    host.start();
    host.command('W');
    host.out(ports::C4, event::ZERO | event::REF);
    host.command('R', 16'344, 2);
    host.command('P', 100'000, 3);
    host.command('G');
    host.run(milliseconds(100));
    host.set("zero", 1);
    host.run(microseconds(50));
    host.set("zero", 0);
    EXPECT_FALSE(host.status() & stat::EVENT) << "the zero pulse alone";
    host.set("ref", 1);
    host.run(milliseconds(1));
    EXPECT_GT(host.card.position(), 500);
    EXPECT_EQ(host.status() & (stat::REF | stat::ZERO), stat::REF);
    host.set("zero", 1);
    EXPECT_EQ(host.card.position(), 0);
    EXPECT_TRUE(host.status() & stat::EVENT);
    host.run(milliseconds(1));
    host.set("zero", 0);
    host.set("zero", 1);
    EXPECT_EQ(host.card.position(), 10) << "armed once: the next pulse does nothing";
    EXPECT_EQ(host.events(0), event::ZERO | event::REF);
}

TEST(Databoard4002, AReferenceThatIsActiveWhenArmedMustBecomeInactiveFirst) {
    Settings settings;
    settings.zeroing = false;
    Host host(settings);
    host.start();
    host.set("ref", 1);
    host.out(ports::C4, event::REF);
    host.run(milliseconds(1));
    EXPECT_FALSE(host.status() & stat::EVENT);
    host.set("ref", 0);
    host.set("ref", 1);
    EXPECT_TRUE(host.status() & stat::EVENT);
}

TEST(Databoard4002, TheInterruptFollowsReadyAndEventsAsEnabled) {
    Host host;
    host.start();
    EXPECT_EQ(host.level("int"), 0);
    host.out(ports::C4, event::ON_READY);
    EXPECT_EQ(host.level("int"), 0);
    EXPECT_TRUE(host.port.wait(milliseconds(1)));
    EXPECT_EQ(host.level("int"), 1);
    EXPECT_EQ(host.status(), stat::READY | stat::INT);
    host.port.out(ports::C2, 'I');
    EXPECT_EQ(host.level("int"), 0);
    EXPECT_TRUE(host.port.wait(milliseconds(1)));
    host.out(ports::C4, event::ON_EVENT | event::POSITION);
    host.command('R', 16'344, 2);
    host.command('N', 100, 3);
    host.command('G');
    const Instant before = host.kernel.now();
    EXPECT_TRUE(host.port.wait(whole_seconds(1)));
    EXPECT_EQ(host.kernel.now() - before, milliseconds(10) + microseconds(100)) << "100 counts at 10 kHz";
    EXPECT_EQ(host.status(), stat::READY | stat::INT | stat::EVENT);
    EXPECT_EQ(host.events(0), 0x81);
    EXPECT_EQ(host.level("int"), 0);
}

}  // namespace
}  // namespace motionrack::databoard4002
