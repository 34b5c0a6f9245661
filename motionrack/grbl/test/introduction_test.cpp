// G-code senders are recognised; the first bytes of any other client never reach the machine.
#include <motionrack/grbl/introduction.hpp>
#include <random>
#include <tests/environment.hpp>

#include "bench.hpp"

namespace motionrack::grbl {
namespace {

using Verdict = Introduction::Verdict;

struct Greeting {
    const char* who;
    std::string bytes;
};
void PrintTo(const Greeting& row, std::ostream* out) {
    *out << row.who;
}

class GrblSender : public testing::TestWithParam<Greeting> {};
TEST_P(GrblSender, IsIdentifiedByItsFirstBytes) {
    Introduction once;
    EXPECT_EQ(once.receive(GetParam().bytes), Verdict::sender);
    EXPECT_EQ(once.take_bytes(), GetParam().bytes);
}
TEST_P(GrblSender, IsIdentifiedByTheEndOfItsFirstLineIfItsBytesArriveOneByOne) {
    Introduction slow;
    Verdict verdict = Verdict::open;
    for (const char c : GetParam().bytes)
        if (verdict == Verdict::open) verdict = slow.receive({&c, 1});
    EXPECT_EQ(verdict, Verdict::sender);
}
INSTANTIATE_TEST_SUITE_P(
    That, GrblSender,
    testing::Values(Greeting{"bCNC", "\n\n"}, Greeting{"UGS", "?"}, Greeting{"gSender", "\x18"},
                    Greeting{"LaserGRBL", "\x18?"}, Greeting{"cncjs", "$$\n"}, Greeting{"grblControl", "\r\n\r\n"},
                    Greeting{"asks for the build", "$I\r\n"}, Greeting{"asks for modes", "?$G\n"},
                    Greeting{"looks for a Marlin, too", "M115\n"}, Greeting{"looks for wireless", "[ESP800]\n"},
                    Greeting{"drives at once", "g21 g90\nG1 X-1.5 Y+.5 F600\n"}, Greeting{"sends a file", "%\nO1\n"},
                    Greeting{"sends a comment", "(W\xC3\xBCrfel, 10 mm)\nG21\n"}, Greeting{"sends blanks", "  \n"},
                    Greeting{"only holds", "!"}, Greeting{"jogs", "$J=G91 X1 F100\n"}));

class UnknownClient : public testing::TestWithParam<Greeting> {};
TEST_P(UnknownClient, IsIdentifiedByItsFirstBytes) {
    Introduction once;
    EXPECT_EQ(once.receive(GetParam().bytes), Verdict::stranger);
}
INSTANTIATE_TEST_SUITE_P(
    That, UnknownClient,
    testing::Values(Greeting{"fetches", "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"},
                    Greeting{"posts lines", "POST / HTTP/1.1\r\n\r\nG1 X5 F600\n"},
                    Greeting{"has a method of its own", "G1X9 / HTTP/1.1\r\n"},
                    Greeting{"has a command as method", "$X / HTTP/1.1\r\nHost: a\r\n\r\n$X\nG91\nG1X50F1000\n"},
                    Greeting{"has a line and a comment", "G1X9 /;x HTTP/1.1\r\nHost: a\r\n\r\n$X\n"},
                    Greeting{"has a line and a bracket", "G1X9 /(x HTTP/1.0\r\n\r\n"},
                    Greeting{"has a hold and a comment", "! /;x HTTP/1.1\r\n\r\n"},
                    Greeting{"has a long method of holds", std::string(1460, '!')},
                    Greeting{"has empty lines before it", "\r\n\r\n$X / HTTP/1.1\r\n\r\n"},
                    Greeting{"says hello in TLS", std::string("\x16\x03\x01\x02\x00\x18\n\x18!~", 10)},
                    Greeting{"shakes hands for SSH", "SSH-2.0-OpenSSH_9.2p1 Debian-2\r\n"},
                    Greeting{"asks in STUN", std::string("\x00\x03\x00\x08\x21\x12\xA4\x42", 8)},
                    Greeting{"speaks HTTP/2", "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"}, Greeting{"mails", "EHLO here\r\n"},
                    Greeting{"is a telnet", "\xFF\xFD\x03"}, Greeting{"negotiates Redis", "*1\r\n$4\r\nPING\r\n"},
                    Greeting{"knocks with zeros after a reset", std::string("\x18\x00\n", 3)},
                    Greeting{"never ends its line", std::string(600, 'G')}));

TEST(Introduction, StaysOpenUntilTheFirstLineHasEnded) {
    Introduction slow;
    EXPECT_EQ(slow.receive("G1 X1"), Verdict::open);
    EXPECT_EQ(slow.receive("0 F6!00"), Verdict::open);
    EXPECT_EQ(slow.receive("\n"), Verdict::sender);
    EXPECT_EQ(slow.take_bytes(), "G1 X10 F6!00\n");
}

std::string some_bytes(std::mt19937& random, std::size_t min_size, std::size_t max_size) {
    std::string out(min_size + random() % (max_size - min_size + 1), '\0');
    for (char& c : out) c = static_cast<char>(random());
    return out;
}

/// Returns a random packet with more real-time bytes and lines than chance would give.
std::string tempting(std::mt19937& random) {
    std::string out = some_bytes(random, 64, 600);
    const std::vector<std::string> pieces = {"\x18", "!", "~", "?", "\n", "\r\n", "G0X9\n", "$X\n", "\x85", "\x84"};
    for (int i = 0; i < 20; ++i) out.insert(random() % (out.size() + 1), pieces[random() % pieces.size()]);
    return out;
}

std::string first_packet(std::mt19937& random) {
    const std::vector<std::string> methods = {"GET",     "POST",  "PUT",      "HEAD", "OPTIONS", "DELETE", "PATCH",
                                              "CONNECT", "TRACE", "PROPFIND", "$X",   "G1X9",    "!",      "$H"};
    const std::vector<std::string> targets = {"/", "/;", "/(", "/%"};
    switch (random() % 5) {
        case 0:
            return std::string("\x16\x03", 2) + static_cast<char>(random() % 4) + tempting(random);
        case 1:
            return methods[random() % methods.size()] + " " + targets[random() % targets.size()] +
                   std::to_string(random()) + "?!~ HTTP/1." + std::to_string(random() % 2) +
                   "\r\nHost: 127.0.0.1:40123\r\n\r\n" + tempting(random);
        case 2:
            return "SSH-2.0-" + std::to_string(random()) + "\r\n" + tempting(random);
        case 3:
            return std::string("\x00\x01", 2) + tempting(random);
        default:
            return some_bytes(random, 64, 600);
    }
}

/// MOTIONRACK_PACKETS=N sets the number of packets.
TEST(Introduction, PreventsForeignPacketsFromActingOnAMachineThatMoves) {
    std::mt19937 random(static_cast<std::uint32_t>(seed_from_environment()));
    Bench undisturbed(three_axes()), b(three_axes());
    for (Bench* each : {&undisturbed, &b}) EXPECT_EQ(each->ask("G1 X200 F6000\n"), "ok\r\n");
    const std::uint64_t count = trials("MOTIONRACK_PACKETS", 10'000, 100'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::string packet = first_packet(random);
        // A packet that is not wholly random is recognised by its first bytes, however it is split.
        const std::size_t piece = random() % 2 == 0 ? packet.size() : 40 + random() % 40;
        Introduction introduction;
        Verdict verdict = Verdict::open;
        for (std::size_t at = 0; at < packet.size() && verdict == Verdict::open; at += piece)
            verdict = introduction.receive(std::string_view(packet).substr(at, piece));
        if (verdict == Verdict::sender) b.session->receive(introduction.take_bytes());
        ASSERT_EQ(verdict, Verdict::stranger) << "packet " << i;
    }
    for (Bench* each : {&undisturbed, &b}) each->pass(1);
    EXPECT_EQ(b.axis(0), undisturbed.axis(0));
    EXPECT_EQ(b.report(), undisturbed.report());
}

}  // namespace
}  // namespace motionrack::grbl
