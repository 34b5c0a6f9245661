// A port that receives arbitrary bytes.
#include <cstdlib>
#include <random>
#include <tests/environment.hpp>

#include "bench.hpp"

namespace motionrack::grbl {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::StartsWith;

/// MOTIONRACK_SEED=N sets the first seed.
TEST(GrblPort, SurvivesAnyBytesAndEndsItsMotion) {
    const std::uint64_t first = seed_from_environment();
    const std::vector<std::string> pieces = {"G0", "G1",   "X1",     "Y-3",   "Z5",     "F600", "\n",   "\r\n",
                                             "$$", "$G",   "$H",     "$X",    "$J=",    "G91",  "?",    "!",
                                             "~",  "\x18", "\x84",   "\x85",  "\x90",   "\x91", "\x9E", "M3",
                                             "S5", "M0",   "G4P.1",  "$C",    "$SLP",   "(",    ")",    ";",
                                             "%",  "\n",   "G2X1I1", "$10=3", "$RST=*", "\n",   "G92X0"};
    for (std::uint64_t seed = first; seed < first + 40; ++seed) {
        std::mt19937 random(static_cast<std::uint32_t>(seed));
        Bench b(random() % 2 == 0 ? three_axes() : router());
        for (int i = 0; i < 60; ++i) {
            std::string bytes;
            for (auto n = random() % 12; n > 0; --n)
                bytes +=
                    random() % 8 == 0 ? std::string(1, static_cast<char>(random())) : pieces[random() % pieces.size()];
            const std::string out = b.ask(bytes, 0.002 * static_cast<double>(1 + random() % 30));
            for (const char c : out)
                ASSERT_TRUE((c >= ' ' && c <= '~') || c == '\r' || c == '\n') << "MOTIONRACK_SEED=" << seed;
        }
        b.ask("\x18", 3);
        const double place = b.axis(0);
        b.ask("\x18\n", 0.5);
        EXPECT_EQ(b.axis(0), place) << "MOTIONRACK_SEED=" << seed;
        EXPECT_EQ(answers(b.ask("\n\n", 0.1)), 2) << "MOTIONRACK_SEED=" << seed;
    }
}

/// Each line without a reset, a sleep or a hold has one answer, however wrong it is. No line leads beyond the travel,
/// where the alarm would be the answer, as in Grbl.
TEST(GrblPort, AnswersEveryLineOnce) {
    const std::uint64_t first = seed_from_environment();
    const std::vector<std::string> words = {"G0",   "G1",     "X1",  "Y3",      "Z.5", "F600", "$$",    "$G",
                                            "$#",   "$I",     "$X",  "$J=X1F9", "G91", "?",    "\x91",  "M3",
                                            "S5",   "G4P.01", "(a)", ";b",      "%",   "G90",  "$10=1", "$N",
                                            "\xFF", "G80",    "M5",  "M8",      "M9",  "$5=1", "Q",     "=1"};
    for (std::uint64_t seed = first; seed < first + 20; ++seed) {
        std::mt19937 random(static_cast<std::uint32_t>(seed));
        Bench b(three_axes());
        int lines = 0, heard = 0;
        for (int i = 0; i < 100; ++i) {
            std::string line;
            for (auto n = random() % 5; n > 0; --n) line += words[random() % words.size()];
            heard += answers(b.ask(line + "\n", 0.002 * static_cast<double>(random() % 20)));
            ++lines;
            for (int j = 0; heard < lines && j < 500; ++j) heard += answers(b.ask("", 0.1));
            ASSERT_EQ(heard, lines) << "MOTIONRACK_SEED=" << seed << " " << line;
        }
    }
}

TEST(GrblPort, RejectsALineOfAMegabyteAndContinuesTheMotion) {
    Bench b(three_axes());
    b.ask("G1 X100 F6000\n");
    const std::string digits(1 << 20, '1');
    EXPECT_THAT(b.ask("G1 X" + digits + "?\n"), AllOf(StartsWith("<Run|"), EndsWith(">\r\nerror:11\r\n")));
    b.until_idle();
    EXPECT_NEAR(b.axis(0), 100, 1e-3);
}

}  // namespace
}  // namespace motionrack::grbl
