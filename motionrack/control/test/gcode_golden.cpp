// Our canonical motion lines compared with those that LinuxCNC's rs274 printed for the same programs
// (tests/golden/canon).
#include <gtest/gtest.h>

#include <motionrack/control/gcode/codes.hpp>
#include <set>

#include "gcode_corpus.hpp"

namespace motionrack::control::gcode {

namespace {

using namespace testing::corpus;

}  // namespace

class GcodeGolden : public ::testing::TestWithParam<std::string> {};

TEST_P(GcodeGolden, MovesAreThoseOfRs274) {
    const std::string expected = compared(GetParam(), file_text(folder() + GetParam() + ".canon"));
    ASSERT_GT(expected.size(), 50u);
    EXPECT_EQ(compared(GetParam(), printed(file_text(folder() + GetParam() + ".ngc"), {}, settings_of(GetParam()))),
              expected);
}

INSTANTIATE_TEST_SUITE_P(Programs, GcodeGolden, ::testing::ValuesIn(names()),
                         [](const auto& parameter) { return parameter.param; });

TEST(GcodeCorpus, HasMoreThanFiftyProgramsWithEveryWord) {
    EXPECT_GE(names().size(), 50u);
    std::set<int> g, m;
    std::string all;
    for (const std::string& name : names()) {
        Interpreter interpreter(settings_of(name));
        const std::string text = file_text(folder() + name + ".ngc");
        ProgramFlow program_flow(text, settings_of(name), name);
        for (std::string_view line; program_flow.next(line);) {
            ASSERT_TRUE(interpreter.line(line, program_flow.number(), Language::program)) << name << ": " << line;
            ASSERT_TRUE(program_flow.line_accepted(interpreter));
            const Block& block = interpreter.block();
            for (int i = 0; i < g_group_count; ++i)
                if (block.has_g(static_cast<GroupG>(i))) g.insert(block.g[static_cast<std::size_t>(i)]);
            for (int i = 0; i < m_group_count; ++i)
                if (block.has_m(static_cast<GroupM>(i))) m.insert(block.m[static_cast<std::size_t>(i)]);
        }
        all += text;
    }
    for (int tenths = 0; tenths < 1000; ++tenths)
        EXPECT_TRUE(group_of_g(tenths) >= g_group_count || tenths == 50 || tenths == 51 || g.contains(tenths))
            << name_of_g(tenths);  // G5 and G5.1: arcs here, not comparable
    for (int code = 0; code < 100; ++code)
        EXPECT_TRUE(group_of_m(code) == m_unknown || code == 61 || m.contains(code)) << "M" << code;
    for (const char* word : {"sub", "endsub", "return", "call", "if", "elseif", "else", "endif", "while", "endwhile",
                             "do", "repeat", "endrepeat", "break", "continue"})
        EXPECT_NE(all.find(std::string(" ") + word), std::string::npos) << word;
    for (const char* word :
         {"ABS", "ACOS", "ASIN", "ATAN", "COS", "EXISTS", "EXP", "FIX", "FUP", "LN",  "ROUND", "SIN",   "SQRT",  "TAN",
          "MOD", "EQ",   "NE",   "GT",   "GE",  "LT",     "LE",  "AND", "OR",  "XOR", "**",    "DEBUG", "PRINT", "MSG"})
        EXPECT_NE(all.find(word), std::string::npos) << word;
}

TEST(GcodeCanon, PrintsEventsAndColumnsAsRs274Does) {
    const std::string out =
        printed("N10 T2 M6\nS900 M3 M8 (MSG,go)\nN5 G20 G18\nG55\nG61\nM1\nG4 P.5\nM5 M9\nM0\nM2\n");
    const char* expected =
        "    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)\n"
        "    2 N..... SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "    3 N..... SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "    4 N..... SET_XY_ROTATION(0.0000)\n"
        "    5 N10    SELECT_TOOL(2)\n"
        "    6 N10    START_CHANGE()\n"
        "    7 N10    CHANGE_TOOL(2)\n"
        "    8 N..... MESSAGE(\"go\")\n"
        "    9 N..... SET_SPINDLE_SPEED(0, 900.0000)\n"
        "   10 N..... START_SPINDLE_CLOCKWISE(0)\n"
        "   11 N..... FLOOD_ON()\n"
        "   12 N5     SELECT_PLANE(CANON_PLANE_XZ)\n"
        "   13 N5     USE_LENGTH_UNITS(CANON_UNITS_INCHES)\n"
        "   14 N..... SET_G5X_OFFSET(2, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "   15 N..... SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "   16 N..... SET_XY_ROTATION(0.0000)\n"
        "   17 N..... SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)\n"
        "   18 N..... OPTIONAL_PROGRAM_STOP()\n"
        "   19 N..... DWELL(0.5000)\n"
        "   20 N..... STOP_SPINDLE_TURNING(0)\n"
        "   21 N..... MIST_OFF()\n"
        "   22 N..... FLOOD_OFF()\n"
        "   23 N..... PROGRAM_STOP()\n"
        "   24 N..... SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"
        "   25 N..... SET_XY_ROTATION(0.0000)\n"
        "   26 N..... SET_FEED_MODE(0, 0)\n"
        "   27 N..... SET_FEED_RATE(0.0000)\n"
        "   28 N..... STOP_SPINDLE_TURNING(0)\n"
        "   29 N..... PROGRAM_END()\n";
    EXPECT_EQ(out, expected);
}

namespace {

/// Returns only the calls about modes that M70 saves.
std::string mode_lines(const std::string& canon) {
    std::string out;
    std::istringstream lines(canon);
    for (std::string line; std::getline(lines, line);)
        for (const char* call : {"USE_LENGTH_UNITS", "SET_FEED_RATE", "SELECT_PLANE", "SET_G5X_OFFSET",
                                 "SET_G92_OFFSET", "SET_XY_ROTATION", "FEED_OVERRIDE", "SPEED_OVERRIDE", "FEED_HOLD"})
            if (line.find(call) != std::string::npos) out += line.substr(line.rfind(' ', line.find(call)) + 1) + '\n';
    return out;
}

}  // namespace

TEST(GcodeCanon, PrintsRestoredModesAsRs274Does) {
    // Before these calls, rs274 omits a G54 that changes nothing.
    for (const auto& [name, from] :
         {std::pair("overrides", "USE_LENGTH_UNITS"), std::pair("modes_kept", "SET_FEED_RATE(5.0000)")}) {
        const std::string ours = mode_lines(printed(file_text(folder() + name + ".ngc"))),
                          theirs = mode_lines(file_text(folder() + name + ".canon"));
        EXPECT_EQ(ours.substr(ours.find(from)), theirs.substr(theirs.find(from))) << name;
    }
    const std::string out = mode_lines(printed(
        "G21 F60\no1 call\nG1 X1\nM2\no1 sub\nM73 G20 G18 F5 M49\nG1 X2\no1 endsub\n", {Coordinates::program, false}));
    EXPECT_NE(out.find("USE_LENGTH_UNITS(CANON_UNITS_INCHES)\nUSE_LENGTH_UNITS(CANON_UNITS_MM)\nSET_FEED_RATE(60.0000)"
                       "\nENABLE_FEED_OVERRIDE()\n"
                       "ENABLE_SPEED_OVERRIDE(0)\nSELECT_PLANE(CANON_PLANE_XY)\n"),
              std::string::npos)
        << out;
}

TEST(GcodeCanon, PrintsMachineCoordinatesWhenAsked) {
    const CanonOptions options = {Coordinates::machine, false};
    const std::string out = printed("G10 L2 P1 X10\nG20 G0 X1\n", options);
    EXPECT_NE(out.find("STRAIGHT_TRAVERSE(35.4000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"), std::string::npos)
        << out;
}

}  // namespace motionrack::control::gcode
