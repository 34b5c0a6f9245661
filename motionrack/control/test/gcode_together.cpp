// The language, cutter compensation, curves and probing in one program: each continues across the lines of the others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using ::testing::HasSubstr;

/// Returns the ends of a program's moves. A probing move that ends below Z = `edge` makes contact there; the machine
/// stops 0.1 mm below.
std::vector<Point> probing_at(std::string_view text, double edge) {
    ProgramReader reader(text, testing::machine());
    std::vector<Point> ends;
    for (;;) {
        const auto step = reader.next();
        EXPECT_TRUE(step) << step.error().text();
        if (!step || *step == nullptr) return ends;
        if ((*step)->kind != CanonCallKind::move) continue;
        ends.push_back((*step)->move.end);
        if ((*step)->probe == Probe::none) continue;
        Point at = ends.back(), stopped_at = at;
        const bool hit = at[2] < edge;
        if (hit) {
            at[2] = edge;
            stopped_at[2] = edge - 0.1;
        }
        reader.set_probe_result(hit, at, stopped_at);
    }
}

std::string problem_together(const std::string& program, const Settings& settings = testing::machine()) {
    const auto read = testing::read(program, settings);
    return read.problems.empty() ? "" : read.problems[0].text();
}

}  // namespace

TEST(GcodeTogether, AProbeDecidesWhichLinesComeNext) {
    constexpr std::string_view program =
        "G21 G90 G94 F100\nG10 L2 P1 Z5\no1 sub\n  G91 G38.3 Z-2\n  G90\no1 endsub [#5063]\n#1 = 0\n"
        "o100 do\n  o1 call\n  #1 = [#1 + 1]\no100 while [#5070 EQ 0]\nG0 X#1 Y#5063 Z[#<_value> + 1]\nM2\n";
    const auto ends = probing_at(program, -3.25);  // probes to machine Z -2, then to -4, with contact
    ASSERT_EQ(ends.size(), 3u);
    EXPECT_EQ(ends[1][2], -4);
    EXPECT_EQ(ends[2][0], 2);
    EXPECT_EQ(ends[2][1], -8.25);
    EXPECT_EQ(ends[2][2], -2.25);  // program Z -7.25
}

TEST(GcodeTogether, AMissReportsTheEndInTheUnitsAndRotationOfTheProgram) {
    const auto ends = probing_at(
        "G21 G90 F100\nG10 L2 P1 X3 R90\nG20 F4\nG38.3 Z-1\nG21\nG10 L2 P1 X0 R0\nG0 X#5063 Y[#5062 * 25.4] Z#5070\n",
        -100);
    ASSERT_EQ(ends.size(), 2u);
    EXPECT_NEAR(ends[1][0], -1, 1e-12);
    EXPECT_NEAR(ends[1][1], 3, 1e-12);  // machine X 0 is 3 mm along the rotated Y
    EXPECT_EQ(ends[1][2], 0);
}

TEST(GcodeTogether, CompensatesARotatedContourAsAnUnrotatedOne) {
    const std::string contour =
        "G0 X-20 Y-20 Z5\nG41.1 D6\nG1 X0 Y0\nG1 X30\nG1 X30 Z-1\nG2 X50 Y20 J20 I0\nG3 X60 Y30 R10\nG1 X0 Y60 Z2\nG1 "
        "Y10\nG40 G0 X-20 Y0\n";
    const auto plain = testing::read("G21 G90 F100\n" + contour).moves();
    const auto turned = testing::read("G21 G90 F100\nG10 L2 P1 X7 Y-2 R37\n" + contour).moves();
    ASSERT_EQ(plain.size(), turned.size());
    ASSERT_GT(plain.size(), 8u);
    const double angle = 37 * std::acos(-1.0) / 180, c = std::cos(angle), s = std::sin(angle);
    for (std::size_t i = 0; i < plain.size(); ++i) {
        EXPECT_EQ(plain[i].kind, turned[i].kind);
        EXPECT_EQ(plain[i].turns, turned[i].turns);
        EXPECT_NEAR(turned[i].end[0], 7 + c * plain[i].end[0] - s * plain[i].end[1], 1e-8) << i;
        EXPECT_NEAR(turned[i].end[1], -2 + s * plain[i].end[0] + c * plain[i].end[1], 1e-8) << i;
        EXPECT_EQ(turned[i].end[2], plain[i].end[2]);
    }
    EXPECT_THAT(problem_together("G10 L2 P1 R30\nG18 G41.1 D2\n"), HasSubstr("in G17 only"));
    EXPECT_THAT(problem_together("G10 L2 P1 R30\nG17 G41.1 D2\nG1 X9 F9\nG10 L2 P1 R3\n"),
                HasSubstr("cutter compensation is on"));
}

TEST(GcodeTogether, RotatesASplineWithItsWorkOffset) {
    const std::string curves = "G0 X1 Y2\nG5 X20 Y0 I5 J10 P-5 Q10\nG5 X40 Y5 P-4 Q-3\nG5.1 X60 Y0 I10 J10\n";
    const auto plain = testing::read("G21 G90 F100\n" + curves).moves();
    const auto turned = testing::read("G21 G90 F100\nG10 L2 P1 R90\n" + curves).moves();
    ASSERT_EQ(plain.size(), turned.size());
    ASSERT_GT(plain.size(), 6u);
    for (std::size_t i = 0; i < plain.size(); ++i) {
        EXPECT_NEAR(turned[i].end[0], -plain[i].end[1], 1e-6);
        EXPECT_NEAR(turned[i].end[1], plain[i].end[0], 1e-6);
    }
}

TEST(GcodeTogether, RestoresModesAfterTheQueuedCompensationMoves) {
    EXPECT_THAT(problem_together("G21 G90 F100\nM70\nG55\nG41.1 D4\nG1 X20\nM72\n"),
                HasSubstr("the work offset cannot change"));
    EXPECT_THAT(problem_together("G20\no1 sub\nM73\nG21 F100 G41.1 D4\nG1 X20\no1 endsub\no1 call\nM2\n"),
                HasSubstr("M73 restores"));
    EXPECT_EQ(
        problem_together("G21 G90 F100\no1 sub\nM73\nG61 F50 G41.1 D4\nG1 X20\nX40\no1 endsub\no1 call\nG40\nM2\n"),
        "");
    EXPECT_THAT(problem_together("M61 Q1\nG41.1 D4\nM61 Q2\n"), HasSubstr("M61"));
}

TEST(GcodeTogether, DeliversQueuedMovesAtTheEndOfAProgram) {
    const auto moves = testing::read(
                           "G21 G90 F100\no1 repeat [3]\nG91 G41.1 D4\nG1 X20\nG1 X10\nG40\nG1 Y-10\no1 "
                           "endrepeat\nG42.1 D2\nG1 X20\no2 if [1]\nG1 X5\no2 endif")
                           .moves();
    ASSERT_EQ(moves.size(), 11u);
    EXPECT_EQ(moves.back().end[0], 115);
}

}  // namespace motionrack::control::gcode
