// Lathe cycles G70 .. G72.2 in programs: fillets and chamfers, final position, and refused uses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <motionrack/control/gcode/cutter_geometry.hpp>
#include <motionrack/control/gcode/plane_point.hpp>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

using testing::Refused;

TEST(GcodeLathe, AFilletTouchesBothSidesAndAChamferHasItsEnds) {
    const auto pieces = [](double radius, bool chamfer) {
        std::vector<ContourSegment> contour(2);
        contour[0] = {{0, 10}, {-10, 10}, 0, {}, radius, chamfer, 1};
        contour[1] = {{-10, 10}, {-10, 20}, 0, {}, 0, false, 2};
        EXPECT_EQ(insert_fillets(contour), "");
        return contour;
    };
    const auto fillet = pieces(2, false), chamfer = pieces(2, true);
    ASSERT_EQ(fillet.size(), 3u);
    EXPECT_NEAR(fillet[1].centre.first, -8, 1e-12);
    EXPECT_NEAR(fillet[1].centre.second, 12, 1e-12);
    EXPECT_EQ(fillet[1].turns, -1);
    ASSERT_EQ(chamfer.size(), 3u);
    EXPECT_EQ(chamfer[1].turns, 0);
    EXPECT_NEAR(chamfer[1].from.first, -8, 1e-12);
    EXPECT_NEAR(chamfer[1].to.second, 12, 1e-12);
    std::vector<ContourSegment> straight(2);
    straight[0] = {{0, 10}, {-10, 10}, 0, {}, 2, false, 1};
    straight[1] = {{-10, 10}, {-20, 10}, 0, {}, 0, false, 2};
    EXPECT_THAT(insert_fillets(straight), ::testing::HasSubstr("no corner for A or C at the end of line 1"));
}

TEST(GcodeLathe, EndsACycleAtTheContourEndWithTheModesOfTheProgram) {
    const std::string sub = "o1 sub\nG0 X10 Z2\nG1 Z-30 F7 S5 M3\n#9=3\nX20\no1 endsub\n";
    const auto read = testing::read("G21 G18 G90 F600\n" + sub + "#9=1\nG0 X25 Z5\nG71 Q1 I6 (turn) M8\nG91\nG1 X#9\n");
    EXPECT_EQ(read.problems.size(), 0u);
    const auto moves = read.moves();
    ASSERT_GT(moves.size(), 5u);
    EXPECT_EQ(moves.back().end[0], 26) << "what the contour sets is not kept";
    EXPECT_EQ(moves.back().end[2], -30);
    int events = 0;
    for (const CanonCall& step : read.steps) {
        events += step.kind != CanonCallKind::move;
        if (step.kind == CanonCallKind::move && step.move.kind == MoveKind::feed) {
            EXPECT_EQ(step.move.feed, 10);
        }
    }
    EXPECT_EQ(events, 2) << "coolant and a comment; the contour has none";
    for (const Move& move : moves) EXPECT_EQ(move.end[1], 0);
}

TEST(GcodeLathe, AreRefusedWithTheirLocation) {
    const std::string before =
        "G21 G18 G90 F600\no1 sub\nG0 X10 Z2\nG1 Z-30\nX20\no1 endsub\no2 sub\nG0 X10 Z2\nG1 Z-30\nG1 X20 Z-20\no2 "
        "endsub\no3 sub\no3 endsub\n"
        "o4 sub\nG0 X10 Z2\nG1 Z-10\nX5 Z-12\nZ-13\nX10 Z-15\no4 endsub\no5 sub\nG2 X10 Z2 R9\nG1 Z9\no5 endsub\no6 "
        "sub\nG0 X1 Z1\nG1 Z-9 Y2\no6 endsub\n"
        "o7 sub\nG0 X1 Z1\nG71 Q1\no7 endsub\nG0 X25 Z5\n";
    const Refused rows[] = {{"G71", 1, "Q word missing: G71 needs the number of the sub"},
                            {"G71 Q1.5", 5, "an integer"},
                            {"G71 Q9", 1, "o9 call: this program has no o9 sub"},
                            {"G71 Q1 I0", 8, "I is the depth"},
                            {"G71 Q1 D-1", 8, "a distance, 0 or more"},
                            {"G71 Q1 R-1", 8, "a distance, 0 or more"},
                            {"G71 Q1 P2", 8, "nothing on this line uses"},
                            {"G70 Q1 I2", 8, "nothing on this line uses"},
                            {"G70 Q1 P0", 8, "from 1"},
                            {"G71 Q1 Y2", 8, "X and Z only"},
                            {"G71 Q1 A2", 8, "X and Z only"},
                            {"G17 G71 Q1", 5, "write G18"},
                            {"G93 G71 Q1 F1", 5, "inverse time"},
                            {"G41.1 D1 G71 Q1", 10, "cutter compensation"},
                            {"G71 Q1 M2", 1, "on a separate line"},
                            {"G71 Q1 G92 X1", 1, "on a separate line"},
                            {"G71 Q2", 1, "the contour reverses along Z in line 10"},
                            {"G72 Q4", 1, "ends at its start along X"},
                            {"G71 Q3", 1, "has no contour"},
                            {"G71 Q4 D5", 1, "is too tight for an offset"},
                            {"G71 Q1 X600", 8, "X600 leads to"},
                            {"G71 Q1\nX5", 1, "no motion is active"}};
    for (const Refused& row : rows) {
        SCOPED_TRACE(row.program);
        const std::string text = before + row.program;
        const auto read = testing::read(text);
        ASSERT_EQ(read.problems.size(), 1u);
        EXPECT_EQ(read.problems[0].location.line, 1 + std::count(text.begin(), text.end(), '\n'));
        EXPECT_EQ(read.problems[0].location.column, row.column);
        EXPECT_THAT(read.problems[0].message, ::testing::HasSubstr(row.says));
    }
    const struct {
        const char* line;
        int at;
        const char* says;
    } inside[] = {{"G71 Q5", 22, "must be a straight move to its start"},
                  {"G71 Q6", 27, "X and Z only"},
                  {"G71 Q7", 31, "within the contour of another cycle"}};
    for (const auto& row : inside) {
        const auto read = testing::read(before + row.line);
        ASSERT_EQ(read.problems.size(), 1u) << row.line;
        EXPECT_EQ(read.problems[0].location.line, row.at) << row.line;
        EXPECT_THAT(read.problems[0].message, ::testing::HasSubstr(row.says));
    }
    EXPECT_FALSE(Interpreter(testing::machine()).line("G71 Q1", 1)) << "a sender's line";
    EXPECT_FALSE(Interpreter(testing::machine()).line("G18 G71 Q1 F5", 1, Language::expressions));
}

TEST(GcodeLathe, ARefusedCycleMovesNothingAndTheProgramContinues) {
    const auto read =
        testing::read("G18 F600\no1 sub\nG0 X10 Z2\nG1 Z-700\nX20\no1 endsub\nG0 X25 Z5\nG71 Q1\nG0 X1\n");
    ASSERT_EQ(read.problems.size(), 1u);
    EXPECT_THAT(read.problems[0].message, ::testing::HasSubstr("G71 leads to Z = -700 mm"));
    EXPECT_EQ(read.problems[0].location.line, 8);
    ASSERT_EQ(read.moves().size(), 2u);
    EXPECT_EQ(read.moves()[1].end[2], 5);
}

}  // namespace motionrack::control::gcode
