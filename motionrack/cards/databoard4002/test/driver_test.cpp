// The function library: its exact traffic, and its behaviour with a card that moves, stops, hangs or is absent.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/test/host.hpp>
#include <vector>

namespace motionrack::databoard4002 {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// ---- exact traffic

struct PortAccess {
    char kind;  // 'o', 'i'
    int port;
    int value;
    friend bool operator==(const PortAccess&, const PortAccess&) = default;
};
std::ostream& operator<<(std::ostream& out, const PortAccess& a) {
    return out << a.kind << a.port << ' ' << a.value;
}

/// Answers STAT with Ready after a few reads, DATA from a list; records all writes.
class ScriptedPort final : public BytePort, public Interrupt {
  public:
    void out(std::uint8_t port, std::uint8_t value) override {
        if (port == ports::CS) return;
        accesses.push_back({'o', port, value});
        busy = 2;
    }
    std::uint8_t in(std::uint8_t port) override {
        if (port == ports::STAT) return busy > 0 ? (--busy, std::uint8_t{0}) : stat::READY;
        const std::uint8_t value = answers.empty() ? std::uint8_t{0} : answers.front();
        if (!answers.empty()) answers.erase(answers.begin());
        accesses.push_back({'i', port, value});
        busy = 2;
        return value;
    }
    bool wait(Duration time) override { return time_ += time, false; }
    void pass(Duration time) override { time_ += time; }
    Instant now() const override { return time_; }

    std::vector<PortAccess> accesses;
    std::vector<std::uint8_t> answers;
    int busy = 0;

  private:
    Instant time_{};
};

TEST(Databoard4002Driver, SendsLettersAndBytesInTheOrderOfTheDescription) {
    ScriptedPort port;
    Driver driver(port, port);
    ASSERT_TRUE(driver.set_number(-10));
    EXPECT_THAT(port.accesses, ElementsAre(PortAccess{'o', 3, 'N'}, PortAccess{'o', 0, 0xF6}, PortAccess{'o', 0, 0xFF},
                                           PortAccess{'o', 0, 0xFF}));
    port.accesses.clear();
    ASSERT_TRUE(driver.set_rate(63 * 256 + 240));
    EXPECT_THAT(port.accesses, ElementsAre(PortAccess{'o', 3, 'R'}, PortAccess{'o', 0, 240}, PortAccess{'o', 0, 63}));
    port.accesses.clear();
    port.answers = {0xFE, 0xFF, 0xFF};
    EXPECT_EQ(*driver.position(), -2);
    EXPECT_THAT(port.accesses, ElementsAre(PortAccess{'o', 3, 'P'}, PortAccess{'i', 0, 0xFE}, PortAccess{'i', 0, 0xFF},
                                           PortAccess{'i', 0, 0xFF}));
    port.accesses.clear();
    port.answers = {0x21};
    EXPECT_EQ(driver.enable_events(0x21)->word, 0x21);
    EXPECT_THAT(port.accesses, ElementsAre(PortAccess{'o', 5, 0x21}, PortAccess{'i', 0, 0x21}));
    port.accesses.clear();
    SlopeTable table;
    table.set(0, {14'000, 256});
    ASSERT_TRUE(driver.set_slope(table));
    ASSERT_EQ(port.accesses.size(), 241u);
    EXPECT_EQ(port.accesses[1], (PortAccess{'o', 0, 14'000 & 0xFF}));
    EXPECT_EQ(port.accesses[2], (PortAccess{'o', 0, 14'000 >> 8}));
    EXPECT_EQ(port.accesses[4], (PortAccess{'o', 0, 1}));
    std::vector<char> letters;
    port.accesses.clear();
    for (auto call : {&Driver::athome, &Driver::go, &Driver::initialise, &Driver::lock, &Driver::manual,
                      &Driver::on_regulation, &Driver::quit, &Driver::clear_watch_out})
        ASSERT_TRUE((driver.*call)());
    for (const PortAccess& a : port.accesses) letters.push_back(static_cast<char>(a.value));
    EXPECT_THAT(letters, ElementsAre('A', 'G', 'I', 'L', 'M', 'O', 'Q', 'W'));
}

TEST(Databoard4002Driver, RejectsValuesOutOfRangeAndSendsNothing) {
    ScriptedPort port;
    Driver driver(port, port);
    EXPECT_FALSE(driver.set_target(8'388'608));
    EXPECT_FALSE(driver.set_deviation(-1));
    EXPECT_FALSE(driver.set_rate(16'384));
    EXPECT_FALSE(driver.to_counts(1e9));
    EXPECT_FALSE(driver.to_counts(0.0 / 0.0 * 0));
    EXPECT_FALSE(driver.find_zero(0x20, 0, 14'000, whole_seconds(1)));
    EXPECT_TRUE(port.accesses.empty());
    EXPECT_THAT(driver.set_number(-9'000'000).error().message, HasSubstr("-9000000, but must be -8388608 to 8388607"));
    EXPECT_EQ(*driver.to_counts(-1.2345), -1'234);
}

// ---- against the virtual card

struct Rig {
    Rig() : driver(host.port, host.port) {
        host.start();
        EXPECT_EQ(*driver.connect(), 0x20);
        EXPECT_TRUE(driver.set_rate(16'344));
    }
    Host host;
    Driver driver;
};

TEST(Databoard4002Driver, MovesByPollingAndByInterruptAlike) {
    for (const Waiting how : {Waiting::polling, Waiting::interrupt}) {
        Rig rig;
        ASSERT_TRUE(rig.driver.move_to(2'000, whole_seconds(1), how));
        EXPECT_EQ(*rig.driver.position(), 2'000);
        ASSERT_TRUE(rig.driver.move_by(-500, whole_seconds(1), how));
        EXPECT_EQ(*rig.driver.position(), 1'500);
        ASSERT_TRUE(rig.driver.move_to_mm(0.25, whole_seconds(1), how));
        EXPECT_DOUBLE_EQ(*rig.driver.position_mm(), 0.25);
        EXPECT_EQ(*rig.driver.rate(), 0);
        EXPECT_TRUE(rig.host.conditions().empty());
    }
}

TEST(Databoard4002Driver, WaitsWithoutTimeoutIfAllowed) {
    for (const Waiting how : {Waiting::polling, Waiting::interrupt}) {
        Rig rig;
        const auto moved = rig.driver.move_to(2'000, never, how);
        ASSERT_TRUE(moved) << moved.error().message;
        EXPECT_EQ(*rig.driver.position(), 2'000);
        ASSERT_TRUE(rig.driver.enable_events(event::POSITION));
        ASSERT_TRUE(rig.driver.set_target(1'000));
        ASSERT_TRUE(rig.driver.go());
        const auto seen = rig.driver.wait_event(event::POSITION, never, how);
        ASSERT_TRUE(seen) << seen.error().message;
        EXPECT_EQ(*rig.driver.position(), 1'000);
    }
    Host host;
    Driver patient(host.port, host.port, {.ready_timeout = never});
    host.start();
    host.run(milliseconds(1));
    EXPECT_TRUE(patient.connect());
}

TEST(Databoard4002Driver, ReportsTheActiveStopAndThePosition) {
    for (const Waiting how : {Waiting::polling, Waiting::interrupt}) {
        Rig rig;
        // The stop is reached while the driver waits: a broken wire after 50 ms, detected at the next poll.
        const auto moved = [&] {
            rig.host.port.on_slice(milliseconds(50), [&, n = 0]() mutable {
                if (++n == 2) rig.host.card.fault("esr.broken", 1, rig.host.kernel.now());
            });
            return rig.driver.move_to(5'000, whole_seconds(1), how);
        }();
        ASSERT_FALSE(moved);
        EXPECT_EQ(moved.error().kind, ErrorKind::machine);
        EXPECT_THAT(moved.error().message, HasSubstr("the right end stop is active"));
        EXPECT_FALSE(rig.host.card.moving());
        ASSERT_TRUE(rig.driver.move_to(0, whole_seconds(1), how)) << "the other direction is free";
        const auto blocked = rig.driver.move_to(100, milliseconds(200), how);
        ASSERT_FALSE(blocked);
        EXPECT_THAT(blocked.error().message, HasSubstr("within 0.200 s"));
        EXPECT_THAT(blocked.error().message, HasSubstr("the right end stop is active"));
    }
}

TEST(Databoard4002Driver, RejectsMovesDuringAnEmergencyStopAndAfterAReset) {
    Rig rig;
    rig.host.set("ems", 1);
    const auto moved = rig.driver.move_to(100, whole_seconds(1));
    ASSERT_FALSE(moved);
    EXPECT_THAT(moved.error().message, HasSubstr("emergency stop is active"));
    rig.host.set("ems", 0);
    rig.driver.reset();
    const auto again = rig.driver.move_to(100, whole_seconds(1));
    ASSERT_FALSE(again);
    EXPECT_THAT(again.error().message, HasSubstr("Connect to it, then set both again"));
}

TEST(Databoard4002Driver, ReportsATimeoutOfAHungCardAndDetectsItsRestart) {
    Rig rig;
    rig.host.wait_ready();
    rig.host.card.fault("watchdog.hang", 1, rig.host.kernel.now());
    ASSERT_TRUE(rig.driver.lock()) << "it was Ready still";
    const Instant before = rig.host.kernel.now();
    const auto sent = rig.driver.manual();
    ASSERT_FALSE(sent);
    EXPECT_THAT(sent.error().message, HasSubstr("Card 13 was not Ready for M within 127 ms"));
    EXPECT_NEAR(to_seconds(rig.host.kernel.now() - before), 0.127, 0.001);
    rig.host.run(whole_seconds(1));
    EXPECT_FALSE(rig.driver.move_to(10, whole_seconds(1)));
}

TEST(Databoard4002Driver, DetectsAResetWhileWaiting) {
    Rig rig;
    ASSERT_TRUE(rig.driver.enable_events(event::POSITION));
    rig.driver.reset();
    rig.host.out(ports::C4, event::POSITION);
    rig.host.command('R', 16'344, 2);
    rig.host.command('N', 1, 3);
    rig.host.command('G');
    EXPECT_FALSE(rig.driver.wait_event(event::POSITION, whole_seconds(1)));
}

TEST(Databoard4002Driver, ReportsThatNoCardAnswers) {
    Host host;
    host.start();
    Driver driver(host.port, host.port, {.select = 7});
    const auto there = driver.connect();
    ASSERT_FALSE(there);
    EXPECT_THAT(there.error().message, HasSubstr("No card answers under the number 7"));
}

TEST(Databoard4002Driver, ATimeOutEndsTheMove) {
    Rig rig;
    const auto moved = rig.driver.move_to(100'000, milliseconds(300));
    ASSERT_FALSE(moved);
    rig.host.wait_ready();
    EXPECT_FALSE(rig.host.card.moving());
}

TEST(Databoard4002Driver, AStopOnRequestEndsTheMove) {
    Rig rig;
    std::atomic<bool> stop = true;
    rig.host.port.set_stop_flag(&stop);
    const auto moved = rig.driver.move_to(100'000, whole_seconds(20));
    ASSERT_FALSE(moved);
    EXPECT_EQ(moved.error().kind, ErrorKind::stopped);
    rig.host.wait_ready();
    EXPECT_FALSE(rig.host.card.moving());
}

TEST(Databoard4002Driver, TwoDriversShareABus) {
    Host host;
    Card other(host.kernel, "c2");
    other.connect_encoder(other.pulses());
    host.bus.plug(other, 14);
    host.start();
    Driver one(host.port, host.port), two(host.port, host.port, {.select = 14});
    for (Driver* d : {&one, &two}) {
        ASSERT_TRUE(d->connect());
        ASSERT_TRUE(d->set_rate(16'344));
    }
    ASSERT_TRUE(two.set_target(20'000));
    ASSERT_TRUE(two.go());
    ASSERT_TRUE(one.move_to(1'000, whole_seconds(1), Waiting::interrupt));
    EXPECT_EQ(*one.position(), 1'000);
    EXPECT_TRUE(other.moving());
}

}  // namespace
}  // namespace motionrack::databoard4002
