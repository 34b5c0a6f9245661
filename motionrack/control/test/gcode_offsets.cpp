// Work systems, their rotation, tool tables, tool lengths, and saved modes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/control/gcode/number.hpp>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using ::testing::HasSubstr;

Settings with_tools() {
    Settings settings = testing::machine("XYZABC", 1e4);
    settings.start_in_g0 = true;
    settings.tools = *read_tool_table("T1 P1 Z10 D3\n;a remark\n\nT2 P7 X1 Z20 D6 I90 J30 Q2 ;end mill\nt99999z-1.5\n");
    return settings;
}

Point last_end(const std::string& program, const Settings& settings = with_tools()) {
    const auto read = testing::read(program, settings);
    for (const Problem& problem : read.problems) ADD_FAILURE() << problem.text();
    const auto moves = read.moves();
    return moves.empty() ? Point{} : moves.back().end;
}

std::string problem_with_tools(const std::string& program, const Settings& settings = with_tools()) {
    const auto read = testing::read(program, settings);
    return read.problems.size() == 1 ? read.problems[0].text()
                                     : "there are " + std::to_string(read.problems.size()) + " problems";
}

void expect_near(const Point& got, double x, double y, double z) {
    EXPECT_NEAR(got[0], x, 1e-9);
    EXPECT_NEAR(got[1], y, 1e-9);
    EXPECT_NEAR(got[2], z, 1e-9);
}

}  // namespace

TEST(GcodeTools, AreReadFromATable) {
    const auto table = with_tools().tools;
    ASSERT_EQ(table.tools().size(), 3u);
    const Tool& tool = *table.find(2);
    EXPECT_EQ(tool.pocket, 7);
    EXPECT_EQ(tool.offset, (Point{1, 0, 20, 0, 0, 0}));
    EXPECT_EQ(tool.diameter_mm, 6);
    EXPECT_EQ(tool.front_angle, 90);
    EXPECT_EQ(tool.back_angle, 30);
    EXPECT_EQ(tool.orientation, 2);
    EXPECT_EQ(table.find(3), nullptr);
    EXPECT_EQ(table.find(99999)->offset[2], -1.5);
    EXPECT_EQ(to_text(tool), "T2 P7 X1 Z20 D6 I90 J30 Q2");
    Tool fine{3, 3, {0, 0, 1e-7}, 5e-5};
    const auto again = read_tool_table(to_text(fine));
    ASSERT_TRUE(again) << again.error().text();
    EXPECT_EQ(again->tools()[0].offset[2], 1e-7);
    EXPECT_EQ(again->tools()[0].diameter_mm, 5e-5);
}

TEST(GcodeTools, AreWrittenWithTheFewestDigitsThatReadBackAsTheSameNumber) {
    const std::pair<double, std::string> rows[] = {
        {1e-7, "0.0000001"},
        {1e-17, "0.00000000000000001"},
        {1 / 3e5, "0.0000033333333333333333"},
        {5e-324, "0." + std::string(323, '0') + "5"},
        {-2.2250738585072014e-308, "-0." + std::string(307, '0') + "22250738585072014"},
        {0.1, "0.1"},
        {999'999'999.99999988, "999999999.9999999"},
        {1e9, "1000000000"},
        {-1e22, "-1" + std::string(22, '0')},
    };
    for (const auto& [value, digits] : rows) {
        const Tool tool{3, 0, {0, 0, value}, value};
        const std::string text = to_text(tool);
        EXPECT_EQ(text, "T3 P0 Z" + digits + " D" + digits);
        const auto again = read_tool_table(text);
        if (std::fabs(value) > largest_number) {
            EXPECT_FALSE(again) << "a number of G-code is not so large";
            continue;
        }
        ASSERT_TRUE(again) << again.error().text();
        EXPECT_EQ(again->tools()[0].offset[2], value);
        EXPECT_EQ(again->tools()[0].diameter_mm, value);
    }
}

TEST(GcodeTools, FaultyTablesAreRefusedWithTheirLocation) {
    struct Row {
        const char* text;
        int line, column;
        const char* says;
    };
    const Row rows[] = {
        {"T1 Z1\nP2", 2, 1, "no tool number"}, {"T1 E5", 1, 4, "'E' is not a word"}, {"T1\nT1", 2, 1, "defined twice"},
        {"T1 Zx", 1, 4, "needs a number"},     {"T1.5", 1, 1, "whole number"},       {"T100000", 1, 1, "whole number"},
        {"T1 Z1 Z2", 1, 7, "twice"},           {"T1 U1", 1, 4, "must be 0"},         {"T0", 1, 1, "no tool number"},
        {"T1 Q10", 1, 4, "from 0 to 9"},       {"?", 1, 1, "'?' is not a word"}};
    for (const Row& row : rows) {
        const auto table = read_tool_table(row.text, "tools.tbl");
        ASSERT_FALSE(table) << row.text;
        EXPECT_EQ(table.error().location.line, row.line) << row.text;
        EXPECT_EQ(table.error().location.column, row.column) << row.text;
        EXPECT_THAT(table.error().text(), HasSubstr(row.says));
        EXPECT_EQ(table.error().file, "tools.tbl");
    }
    std::string many;
    for (int i = 1; i <= 1001; ++i) many += "T" + std::to_string(i) + "\n";
    EXPECT_FALSE(read_tool_table(many));
    EXPECT_TRUE(read_tool_table(""));
}

RC_GTEST_PROP(GcodeTools, OfATableThatIsWrittenAreReadAgain, ()) {
    Tool tool;
    tool.number = *rc::gen::inRange(1, 99'999);
    tool.pocket = *rc::gen::inRange(0, 99);
    tool.offset[2] = *rc::gen::inRange(-100'000, 100'000) / 1000.0;
    tool.diameter_mm = *rc::gen::inRange(0, 100'000) / 1000.0;
    tool.orientation = *rc::gen::inRange(0, 10);
    const auto table = read_tool_table(to_text(tool));
    RC_ASSERT(table.has_value() && table->tools().size() == 1);
    RC_ASSERT(to_text(table->tools()[0]) == to_text(tool));
    RC_ASSERT(table->tools()[0].offset == tool.offset);
}

TEST(GcodeTools, ShiftZByTheirLength) {
    expect_near(last_end("T1 M6 G43 Z5"), 0, 0, 15);
    expect_near(last_end("G43 H2 X3 Z5"), 4, 0, 25);
    expect_near(last_end("T1 M6\nG43\nG43.2 H2\nX0 Z0"), 1, 0, 30);
    expect_near(last_end("G43 H1\nG43.2 Z0.5\nZ0"), 0, 0, 10.5);
    expect_near(last_end("G43 H1\nG49\nZ1"), 0, 0, 1);
    expect_near(last_end("T2 M6 G43 H0 Z0"), 0, 0, 20);
    expect_near(last_end("G43 Z3"), 0, 0, 3);
    expect_near(last_end("G43.1 X1 Z2\nX0 Z0"), 1, 0, 2);
    expect_near(last_end("M61 Q2 G43 Z0"), 0, 0, 20);
    expect_near(last_end("T1 M6\nT2 G43 Z[#5400 + #5403 + #5410 + #<_selected_tool>]"), 0, 0, 10 + (1 + 0 + 3 + 1));
}

TEST(GcodeTools, AreSetByG10) {
    expect_near(last_end("G10 L1 P1 Z7 R2\nG43 H1 Z[#5410]"), 0, 0, 7);
    expect_near(last_end("T1 M6\nG10 L1 P1 Z7 R2\nZ[#5410]"), 0, 0, 4);
    expect_near(last_end("G10 L1 P50 Z4\nG43 H50 Z1"), 0, 0, 5);
    expect_near(last_end("G20 G10 L1 P50 Z1\nG43 H50 Z1"), 0, 0, 50.8);
    // The tool is at machine Z 12; this shall be Z 2 in G54 (offset 4): its length is 6.
    expect_near(last_end("G10 L2 P1 Z4\nG53 G0 Z12\nG10 L10 P1 Z2\nG43 H1 Z0"), 0, 0, 10);
    expect_near(last_end("G10 L2 P9 Z3\nG53 G0 Z12\nG10 L11 P1 Z2\nG43 H1 Z0"), 0, 0, 7);
    // In a rotated system the offset is along the axes of the system, so that the tool does not move.
    expect_near(last_end("G10 L2 P1 R30\nG0 X10 Y5\nG10 L10 P1 X2 Y1\nG43 H1\nX2 Y1"), 6.1602540378443873,
                9.3301270189221928, 0);
    expect_near(last_end("G10 L2 P1 R30\nG0 X10 Y5\nG10 L10 P1 X2\nG43 H1\nX2"), 6.1602540378443873, 9.3301270189221928,
                0);
    expect_near(last_end("G10 L2 P9 R90\nG0 X10 Y5\nG10 L11 P1 X2 Y1\nG59.3 G43 H1\nX2 Y1"), 10, 5, 0);
    EXPECT_THAT(problem_with_tools("G10 L1 P0 Z1"), HasSubstr("the number of a tool"));
    EXPECT_THAT(problem_with_tools("G10 L1 Z1"), HasSubstr("P word missing"));
    EXPECT_THAT(problem_with_tools("G10 L1 P1 Z1 R-1"), HasSubstr("0 or more"));
}

TEST(GcodeTools, MissingFromTheTableAreRejected) {
    EXPECT_THAT(problem_with_tools("T3"), HasSubstr("1:1: T3: the tool table has no tool 3"));
    EXPECT_THAT(problem_with_tools("G43 H3"), HasSubstr("1:5: H3: the tool table has no tool 3"));
    EXPECT_THAT(problem_with_tools("M61 Q3"), HasSubstr("has no tool 3"));
    EXPECT_THAT(problem_with_tools("M61"), HasSubstr("Q word missing"));
    EXPECT_THAT(problem_with_tools("G43.2"), HasSubstr("H word missing"));
    EXPECT_THAT(problem_with_tools("H1"), HasSubstr("nothing on this line uses the H word"));
    EXPECT_EQ(problem_with_tools("T0 M6"), "there are 0 problems");
    EXPECT_THAT(problem_with_tools("T5 M6\nG43", testing::machine()), HasSubstr("--tools FILE"));
}

TEST(GcodeWorkSystems, AreNine) {
    expect_near(last_end("G10 L2 P7 X1\nG10 L2 P8 X2\nG10 L2 P9 X3\nG59.1 X0\nG59.2 X0\nG59.3 X0"), 3, 0, 0);
    expect_near(last_end("G59.1\nG10 L20 P0 X5\nX6"), 1, 0, 0);
    expect_near(last_end("G59.2\nX#<_coord_system>"), 592, 0, 0);
    expect_near(last_end("G59.3\nX#5220"), 9, 0, 0);
    expect_near(last_end("G10 L2 P9 X4 R30\nX[#5381 + #5390]"), 34, 0, 0);
    EXPECT_THAT(problem_with_tools("G10 L2 P10 X1"), HasSubstr("nine work systems"));
}

TEST(GcodeWorkSystems, AreRotatedByR) {
    expect_near(last_end("G10 L2 P1 X10 Y20 R90\nX1 Y2 Z3"), 8, 21, 3);
    expect_near(last_end("G10 L2 P1 R90\nX5\nY1"), -1, 5, 0);
    expect_near(last_end("G10 L2 P1 R90\nX5\nG91 X1"), 0, 6, 0);
    expect_near(last_end("G10 L2 P1 R180\nX5 Y1"), -5, -1, 0);
    expect_near(last_end("G10 L2 P1 R-90\nX5 Y1"), 1, -5, 0);
    expect_near(last_end("G10 L2 P2 R90\nX5"), 5, 0, 0);
    expect_near(last_end("G10 L2 P2 R90\nG55 X5\nG54 X1"), 1, 5, 0);
    expect_near(last_end("G10 L2 P1 R30\nX2\nG53 G0 X1 Y1"), 1, 1, 0);
    expect_near(last_end("G10 L2 P1 X10 R90\nX5\nG92 X0 Y0\nX1 Y1"), -1, 6, 0);
    expect_near(last_end("G10 L2 P1 X10 R90\nX5 Y1\nG10 L20 P1 X0\nX1"), 9, 6, 0);
    expect_near(last_end("G10 L2 P1 X10 R90\nX5 Y1\nX[#5420 * 2] Y[#5421]"), 9, 10, 0);
    expect_near(last_end("T2 M6 G43\nG10 L2 P1 R90\nX5 Y0"), 1, 5, 0);
}

TEST(GcodeWorkSystems, RotateArcsAndCyclesOfTheirPlane) {
    const auto arc = testing::read(
        "G10 L2 P1 R90\nG1 F9 X10\nG2 X12 Y2 I2 J0\nG90.1 G3 X12 Y-2 I12 J0\nG90.1 G3 X10 Y0 R2", with_tools());
    ASSERT_TRUE(arc.problems.empty()) << arc.problems[0].text();
    const auto moves = arc.moves();
    EXPECT_NEAR(moves[1].centre_first, 0, 1e-12);
    EXPECT_NEAR(moves[1].centre_second, 12, 1e-12);
    EXPECT_NEAR(moves[2].centre_first, 0, 1e-12);
    EXPECT_NEAR(moves[2].centre_second, 12, 1e-12);
    EXPECT_EQ(moves[1].turns, -1);
    expect_near(last_end("G10 L2 P1 R90\nF9 G98 G81 X3 Y1 Z-1 R2"), -1, 3, 2);
    expect_near(last_end("G10 L2 P1 R90\nF9 G91 G98 G81 X3 Y1 Z-1 R2 L3"), -3, 9, 2);
    EXPECT_THAT(problem_with_tools("G10 L2 P1 R5\nF9\nG18 G2 X5 Z0 I1 K0"), HasSubstr("rotated by 5 degrees"));
    EXPECT_THAT(problem_with_tools("G10 L2 P1 R5\nF9\nG19 G81 X5 Z0 R1"), HasSubstr("rotated by 5 degrees"));
    EXPECT_THAT(problem_with_tools("G10 L2 P1 R90\nX10001"), HasSubstr("2:1: X10001 leads to Y"));
}

RC_GTEST_PROP(GcodeWorkSystems, TurnBackAndForth, ()) {
    WorkFrame frame;
    for (Point* point : {&frame.work[0], &frame.g92, &frame.tool})
        for (double& value : *point) value = *rc::gen::inRange(-1000, 1000) / 8.0;
    frame.rotation_deg[0] = *rc::gen::inRange(-7200, 7200) / 10.0;
    frame.activate(0);
    Point there = {};
    for (double& value : there) value = *rc::gen::inRange(-1000, 1000) / 8.0;
    const Point back = frame.to_program(frame.to_machine(there));
    for (int axis = 0; axis < axis_count; ++axis) RC_ASSERT(std::fabs(back[axis] - there[axis]) < 1e-10);
    const long double angle = static_cast<long double>(frame.rotation_deg[0]) / 180 * std::acos(-1.0L);
    const long double x = there[0] + frame.g92[0], y = there[1] + frame.g92[1];
    const long double wanted = std::cos(angle) * x - std::sin(angle) * y + frame.work[0][0] + frame.tool[0];
    RC_ASSERT(std::fabs(static_cast<double>(wanted) - frame.to_machine(there)[0]) < 1e-10);
}

TEST(GcodeModes, AreSavedAndRestored) {
    expect_near(last_end("M70\nG20 G91\nX1\nM72\nX1"), 1, 0, 0);
    expect_near(last_end("M70\nG55 G10 L2 P2 X5\nX1\nM72\nX1"), 1, 0, 0);
    expect_near(last_end("M70\nG20\nM71\nX1"), 25.4, 0, 0);
    expect_near(last_end("o1 sub\nM73\nG20 G91\nX1\no1 endsub\no1 call\nX1"), 1, 0, 0);
    expect_near(last_end("o1 sub\nM70\nG20\nX1\no1 endsub\no1 call\nX1"), 25.4, 0, 0);
}

TEST(GcodeModes, ThatAreNotSavedCannotBeRestored) {
    EXPECT_THAT(problem_with_tools("X1 M72"), HasSubstr("1:4: M72 has no modes to restore"));
    EXPECT_THAT(problem_with_tools("M70\nG20\nM71\nM72\nX1"), HasSubstr("4:1: M72 has no modes to restore"));
    EXPECT_THAT(problem_with_tools("o1 sub\nM72\no1 endsub\nM70\no1 call\nM72"),
                HasSubstr("2:1: M72 has no modes to restore"))
        << "each call has its own";
}

TEST(GcodeModes, UnsupportedByTheMachineAreRejected) {
    EXPECT_EQ(problem_with_tools("M48\nM50\nM50 P1\nM51 P1\nM52 P0\nM53 P1\nM60\nG97 S500"), "there are 0 problems");
    for (const char* line : {"M52", "M52 P1"})
        EXPECT_THAT(problem_with_tools(line), HasSubstr("adaptive feed")) << line;
    EXPECT_THAT(problem_with_tools("G7"), HasSubstr("X is a radius here, never a diameter"));
    EXPECT_THAT(problem_with_tools("G8"), HasSubstr("X is always a radius here; leave it out"));
    for (const char* line : {"G33 Z1 K1", "G33.1 Z1 K1", "G76 P1", "G95"})
        EXPECT_THAT(problem_with_tools(line), HasSubstr("angle of the spindle")) << line;
    for (const char* line : {"G87 X1 Z1 R1", "G88 X1 Z1 R1 P1"})
        EXPECT_THAT(problem_with_tools(line), HasSubstr("use G8")) << line;
    EXPECT_THAT(problem_with_tools("G96 D100 S5"), HasSubstr("rev/min"));
}

}  // namespace motionrack::control::gcode
