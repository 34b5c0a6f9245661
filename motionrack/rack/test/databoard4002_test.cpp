// The DataBoard 4002 in a rack, operated through its ports, wires and quantities: by a host and by manual tests.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/rack/session.hpp>
#include <motionrack/rack/test/config_helpers.hpp>

namespace motionrack::rack {
namespace {

using ::testing::HasSubstr;

/// A host with IN and OUT instructions.
struct Host {
    explicit Host(const std::string& text) : session(std::move(*Session::open(text))) {}
    void out(std::uint32_t port, unsigned value, const char* card = "c1") {
        ASSERT_TRUE(session->write(card, 8, port, value));
    }
    unsigned in(std::uint32_t port, const char* card = "c1") { return *session->read(card, 8, port); }
    void ready(const char* card = "c1") {
        for (int i = 0; i < 12'700 && (in(1, card) & 0x80) == 0; ++i) ASSERT_TRUE(session->advance(10'000));
        ASSERT_EQ(in(1, card) & 0x80, 0x80u) << "Ready within 127 ms";
    }
    void command(char letter, std::initializer_list<unsigned> bytes = {}, const char* card = "c1") {
        ready(card);
        out(3, static_cast<unsigned char>(letter), card);
        for (const unsigned byte : bytes) {
            ready(card);
            out(0, byte, card);
        }
    }
    std::unique_ptr<Session> session;
};

TEST(Databoard4002InARack, ACardAlonePositionsItsIdealMotor) {
    Host host("card.c1 = \"databoard4002\"");
    EXPECT_EQ(host.in(1), 0xFFu) << "no card is chosen yet";
    host.out(1, 13);
    host.command('W');
    host.command('R', {0x00, 0x20});        // 400 kHz / (16384 - 8192)
    host.command('P', {0xE8, 0x03, 0x00});  // 1000
    host.command('I');
    host.command('G');
    ASSERT_TRUE(host.session->advance(2'000'000'000));
    EXPECT_NEAR(*host.session->part("c1.fout_hz"), 400e3 / (16384 - 8192), 1e-9);
    EXPECT_EQ(*host.session->peek("c1", "MOVING"), 1);
    EXPECT_GT(*host.session->wire("c1.sign"), 0);
    ASSERT_TRUE(host.session->advance(30'000'000'000));
    EXPECT_EQ(*host.session->part("c1.position_counts"), 1000);
    EXPECT_EQ(*host.session->part("c1.fout_hz"), 0);
    host.command('P');
    host.ready();
    const unsigned low = host.in(0);
    host.ready();
    EXPECT_EQ(low | host.in(0) << 8, 1000u);
}

/// If the card's program hangs, only the relay removes the voltage.
TEST(Databoard4002InARack, AWireSelectsWhetherTheServoIsBehindTheRelayOrBeforeIt) {
    for (const bool direct : {false, true}) {
        Host host(std::string("[card.c1]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"c1\"\n[axis.X.servo]\n") +
                  (direct ? "[wires]\n\"X.drive\" = \"c1.vdirect\"\n" : ""));
        host.out(1, 13);
        host.command('R', {0x00, 0x3E});
        host.command('P', {0x00, 0x00, 0x70});
        host.command('G');
        ASSERT_TRUE(host.session->advance(200'000'000));
        const double volts = *host.session->wire("X.drive");
        EXPECT_GT(volts, 0.2);
        ASSERT_TRUE(host.session->fault("watchdog.hang=1", "c1"));
        ASSERT_TRUE(host.session->set_wire("c1.ems", 1));
        ASSERT_TRUE(host.session->advance(1'000'000));
        EXPECT_EQ(*host.session->wire("c1.vout"), 0);
        EXPECT_EQ(*host.session->wire("X.drive"), direct ? volts : 0) << direct;
    }
}

TEST(Databoard4002InARack, ItsWiresAreVoltsAndLevelsAndAnEndStopHoldsTheMove) {
    Host host("card.c1 = \"databoard4002\"");
    host.out(1, 13);
    host.command('R', {0x00, 0x3C});  // 15360
    host.command('P', {0x00, 0x00, 0x10});
    host.command('G');
    ASSERT_TRUE(host.session->advance(100'000'000));
    const double volts = *host.session->wire("c1.vout");
    EXPECT_GT(volts, 0.2);
    EXPECT_LE(volts, 10.0);
    ASSERT_TRUE(host.session->set_wire("c1.esr", 1));
    ASSERT_TRUE(host.session->advance(100'000'000));
    EXPECT_EQ(*host.session->wire("c1.vout"), 0.0);
    EXPECT_EQ(host.in(1) & 0x20u, 0x20u);
    const std::int64_t there = *host.session->peek("c1", "POSITION");
    ASSERT_TRUE(host.session->advance(100'000'000));
    EXPECT_EQ(*host.session->peek("c1", "POSITION"), there);
}

TEST(Databoard4002InARack, HasTheTrimTableOfItsFile) {
    Host host("[card.c1]\ntype = \"databoard4002\"\ntrim = \"0.5 15000, 10 16383\"\n");
    host.out(1, 13);
    host.command('R', {15'000 & 0xFF, 15'000 >> 8});
    host.command('N', {0x00, 0x00, 0x10});
    host.command('G');
    ASSERT_TRUE(host.session->advance(1'000'000));
    EXPECT_EQ(*host.session->wire("c1.vout"), 0.5);
    const RackReading wrong = read_rack_text("[card.c1]\ntype = \"databoard4002\"\ntrim = \"0.5 15000, 0.4 16383\"\n");
    ASSERT_FALSE(wrong.config);
    EXPECT_THAT(wrong.errors.front().text(), testing::AllOf(HasSubstr("3:"), HasSubstr("Row 2 of the trim table")));
}

TEST(Databoard4002InARack, QuitKeepsTheTargetWhereItsFileRequiresIt) {
    for (const bool zeroes : {true, false}) {
        Host host(std::string("[card.c1]\ntype = \"databoard4002\"\n") + (zeroes ? "" : "quit_zeroes = false\n"));
        host.out(1, 13);
        host.command('R', {16'000 & 0xFF, 16'000 >> 8});
        host.command('P', {0xE8, 0x03, 0x00});
        host.command('Q');
        host.command('G');
        ASSERT_TRUE(host.session->advance(10'000'000'000));
        EXPECT_EQ(*host.session->part("c1.position_counts"), zeroes ? 0 : 1000);
    }
}

TEST(Databoard4002InARack, ForcedEncoderLinesDisconnectTheIdealMotor) {
    Host host("card.c1 = \"databoard4002\"");
    constexpr double quarter[4][2] = {{1, 0}, {1, 1}, {0, 1}, {0, 0}};
    for (int turn = 0; turn < 10; ++turn)
        for (const auto& [a, b] : quarter) {
            ASSERT_TRUE(host.session->set_wire("c1.o1", a));
            ASSERT_TRUE(host.session->set_wire("c1.o2", b));
            ASSERT_TRUE(host.session->advance(100'000));
        }
    EXPECT_EQ(std::abs(*host.session->peek("c1", "POSITION")), 40);
    EXPECT_TRUE(host.session->set_wire("c1.o1", std::nan("")));
    EXPECT_FALSE(host.session->set_wire("c1.vout", 1));
}

TEST(Databoard4002InARack, TwoCardsShareABusAndAnswerToTheirNumbers) {
    Host host(
        "[card.c1]\ntype = \"databoard4002\"\n[card.c2]\ntype = \"databoard4002\"\ncard_number = 7\nversion = 3\n");
    host.out(1, 7);
    host.command('R', {0x00, 0x20});
    host.command('P', {0x64, 0x00, 0x00}, "c1");  // to c2 (number 7): c1 names the shared bus, too
    host.command('G');
    ASSERT_TRUE(host.session->advance(10'000'000'000));
    EXPECT_EQ(*host.session->peek("c2", "POSITION"), 100);
    EXPECT_EQ(*host.session->peek("c1", "POSITION"), 0);
}

TEST(Databoard4002InARack, ACopyContinuesIdentically) {
    Host host("card.c1 = \"databoard4002\"");
    host.out(1, 13);
    host.command('R', {0x00, 0x20});
    host.command('P', {0xE8, 0x03, 0x00});
    host.command('G');
    ASSERT_TRUE(host.session->advance(3'000'000'000));
    const std::unique_ptr<Session> copy = *host.session->copy();
    ASSERT_TRUE(host.session->advance(40'000'000'000));
    ASSERT_TRUE(copy->advance(40'000'000'000));
    EXPECT_EQ(*copy->peek("c1", "POSITION"), 1000);
    EXPECT_EQ(copy->rack().kernel().state_hash(), host.session->rack().kernel().state_hash());
}

TEST(Databoard4002InARack, WrongRackFilesAreRefusedWithTheLocation) {
    const RackReading same =
        read_rack_text("[card.c1]\ntype = \"databoard4002\"\n[card.c2]\ntype = \"databoard4002\"\n");
    ASSERT_EQ(same.errors.size(), 1u);
    EXPECT_THAT(same.errors[0].message, HasSubstr("both the number 13"));
    const RackReading straps = read_rack_text("[card.c1]\ntype = \"databoard4002\"\nfirst_pair = 2\n");
    ASSERT_EQ(straps.errors.size(), 1u);
    EXPECT_EQ(straps.errors[0].location.line, 3);
    EXPECT_THAT(straps.errors[0].message, HasSubstr("quadrature x4"));
    const RackReading axis =
        read_rack_text("[card.c1]\ntype = \"databoard4002\"\n[axis.X]\ncard = \"c1\"\nchannel = \"x\"\n");
    ASSERT_FALSE(axis.errors.empty());
    EXPECT_THAT(axis.errors[0].message, HasSubstr("has only one, without a name: leave the key out"));
    EXPECT_THAT(Session::open("card.c1 = \"databoard4002\"").value()->part("c1.speed").error().message,
                HasSubstr("fout_hz"));
}

}  // namespace
}  // namespace motionrack::rack
