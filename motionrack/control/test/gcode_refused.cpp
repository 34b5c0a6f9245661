// Refused lines: error column, word, Grbl status number and words of the sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using ::testing::HasSubstr;

/// A program whose last line is refused, with the expected error.
struct RefusedLine {
    const char* program;
    int column;
    const char* word;
    int grbl;
    const char* says;
};

const RefusedLine refused[] = {
    // letters and numbers
    {"12", 1, "1", 1, "no letter before it"},
    {"12\xEF", 1, "1", 1, "12 has no letter before it; write e.g. X12"},
    {"G1 X", 4, "X", 2, "X has no number"},
    {"G0 X-", 4, "X-", 2, "no number"},
    {"G0 X.", 4, "X.", 2, "no number"},
    {"G0 X1.2.3", 4, "X1.2.3", 2, "two decimal points"},
    {"G0 X--1", 4, "X--1", 2, "no number"},
    {"G0 X1e999", 4, "X1", 2, "no exponent"},
    {"G0 Xnan", 4, "X", 2, "no number"},
    {"G0 Xinf", 4, "X", 2, "no number"},
    {"G0 X99999999999999999999999999", 4, "X99999999999999999999999999", 2, "too large"},
    {"G0 X1 E5", 7, "E5", 36, "no extruder"},
    {"D1", 1, "D1", 36, "G41"},
    {"H1", 1, "H1", 36, "G43"},
    {"G0 U1", 4, "U1", 20, "axes are X Y Z A B C"},
    {"$H", 1, "$", 3, "system command of Grbl"},
    {"N1 G0 X1*57", 9, "*", 1, "checksums"},
    {"G0 X1 ) Y2", 7, ")", 1, "without '('"},
    {"G0 X1 \xC3\xA9", 7, "\xC3", 1, "0xC3"},
    {"G0 \x01X1", 4, "\x01", 1, "0x01"},
    {"(a\x02)", 3, "\x02", 1, "0x02"},
    {"G0 X1 (never closed", 7, "(", 20, "ends inside this comment"},
    {"(outer (inner))", 8, "(", 20, "do not nest"},
    {"G0 X1 / Y2", 7, "/", 20, "first character"},
    {"G0 X1 %", 7, "%", 20, "alone on its line"},
    {"#1=3 %", 6, "%", 20, "alone on its line"},
    // codes
    {"G1.5 X1", 1, "G1.5", 20, "not a known command"},
    {"G6 X1", 1, "G6", 20, "not a known command"},
    {"G1.05", 1, "G1.05", 20, "not a known command"},
    {"G-1", 1, "G-1", 20, "not a known command"},
    {"G1000", 1, "G1000", 20, "not a known command"},
    {"G38.2 F10", 1, "G38.2", 26, "needs a target to probe towards"},
    {"G38.2 Z-1", 1, "G38.2", 22, "F word missing"},
    {"F10 G38.3 Z0", 5, "G38.3", 33, "no length"},
    {"F10 G38.4 Z1 A1", 5, "G38.4", 36, "does not turn axes"},
    {"G93 F10 G38.5 Z1", 9, "G38.5", 22, "inverse time"},
    {"F10 G38.6 Z1", 5, "G38.6", 20, "not a known command"},
    {"F10 G41.1 D2\nG38.2 X9", 1, "G38.2", 24, "cutter compensation"},
    {"F10 G53 G38.2 Z1", 5, "G53", 30, "G0 or G1"},
    {"G41 X1", 1, "G41", 20, "no tool table"},
    {"G43 H1", 1, "G43", 20, "no tool table"},
    {"G95", 1, "G95", 20, "G94"},
    {"M56", 1, "M56", 20, "does not park"},
    {"M47", 1, "M47", 20, "not a known command"},
    {"M3.5", 1, "M3.5", 20, "not a known command"},
    {"M98 P1", 1, "M98", 20, "this program has no O1"},
    // groups, repeats, leftovers
    {"G0 G1 X1 F1", 4, "G1", 21, "exclude each other"},
    {"G90 X1 G91", 8, "G91", 21, "exclude each other"},
    {"M3 M4", 4, "M4", 21, "exclude each other"},
    {"M8 M9", 4, "M9", 21, "on and off at once"},
    {"G0 X1 X2", 7, "X2", 25, "second X word"},
    {"G0 X1 Y2 x 3", 10, "x 3", 25, "the first is X1"},
    {"G0 X1 I2", 7, "I2", 36, "centre of an arc"},
    {"G0 X1 R2", 7, "R2", 36, "radius"},
    {"G0 X1 P2", 7, "P2", 36, "nothing on this line uses"},
    {"G1 X1 F9 L2", 10, "L2", 36, "G10"},
    {"G64 P.1 Q.1", 9, "Q.1", 36, "peck"},
    {"X1", 1, "X1", 31, "no motion is active"},
    {"G80 X1", 5, "X1", 31, "after G80"},
    {"N1.5", 1, "N1.5", 27, "integers"},
    {"N10000000", 1, "N10000000", 27, "N9999999"},
    {"T1.5", 1, "T1.5", 23, "integer"},
    {"T100000", 1, "T100000", 38, "T99999"},
    {"T-1", 1, "T-1", 4, "negative"},
    {"M6", 1, "M6", 28, "T1 M6"},
    // feeds
    {"G1 X1", 1, "G1", 22, "F word missing: G1 needs a feed; write e.g. F600 (mm/min)"},
    {"G20 G1 X1", 5, "G1", 22, "(inch/min)"},
    {"G1 F0 X1", 4, "F0", 22, "feed 0"},
    {"G1 X1 F-5", 7, "F-5", 4, "F-5 is negative"},
    {"G94 G1 X1 F60\nG93\nX2", 1, "X2", 22, "in G93 every G1 line"},
    {"G93 G1 X1 F60\nX2", 1, "X2", 22, "in G93 every G1 line"},
    {"G93 G1 X1 F60\nG94 X2", 5, "X2", 22, "F word missing"},
    {"S-1", 1, "S-1", 4, "negative"},
    // arcs
    {"F100 G2 X10 Y0", 6, "G2", 35, "I J in G17"},
    {"F100 G18 G2 X10 Z5 J3", 10, "G2", 35, "I K in G18"},
    {"F100 G2", 6, "G2", 26, "needs an end and a centre"},
    {"F100 G2 X10 Y0 I4 J0", 16, "I4", 33, "starts 4 mm from its centre but ends 6 mm"},
    {"F100 G2 X10 Y0 I0 J0", 16, "I0", 33, "radius of this arc is 0"},
    {"F100 G2 X10 Y0 I10", 16, "I10", 33, "its end lies on the centre"},
    {"F100 G2 X10 Y0 R4.99", 16, "R4.99", 34, "at least 5 mm"},
    {"F100 G2 X10 R0", 13, "R0", 33, "radius 0"},
    {"F100 G2 X0 R5", 12, "R5", 33, "cannot end where it starts"},
    {"F100 G2 Z5 R5", 6, "G2", 32, "needs an end in its plane"},
    {"F100 G2 X10 R6 I5", 16, "I5", 36, "none beside R"},
    {"F100 G2 X10 I5 K1", 16, "K1", 36, "I J in G17"},
    {"F100 G90.1 G2 X10 I5", 12, "G2", 35, "J word missing"},
    {"F100 G2 X10 I5 P1.5", 16, "P1.5", 23, "integer"},
    {"F100 G2 X10 I5 P0", 16, "P0", 38, "from 1"},
    {"G2 X10 I5", 1, "G2", 22, "F word missing"},
    // once-only codes
    {"G4", 1, "G4", 28, "P word missing"},
    {"G4 P-1", 4, "P-1", 4, "negative"},
    {"G10 P1 X1", 1, "G10", 28, "L word missing"},
    {"G10 L2 X1", 1, "G10", 28, "P word missing"},
    {"G10 L2 P1", 1, "G10", 26, "axis words missing"},
    {"G10 L3 P1 X1", 5, "L3", 20, "not supported"},
    {"G10 L2 P10 X1", 8, "P10", 29, "nine work systems"},
    {"G10 L2 P1.5 X1", 8, "P1.5", 23, "integer"},
    {"G10 L20 P1 X1 R45", 15, "R45", 36, "nothing on this line uses"},
    {"G92", 1, "G92", 26, "axis words missing"},
    {"G1 G92 X1 F1", 1, "G1", 24, "both use axis words"},
    {"G0 G28 X1", 1, "G0", 24, "both use axis words"},
    {"G0 G43.1 Z1", 1, "G0", 24, "both use axis words"},
    // words that two codes would use
    {"G64 G3 X0 Y0 I-10 P3 F600", 19, "P3", 24, "G64 and G3 both use the P word; put them on two lines"},
    {"M50 P1 G64", 5, "P1", 24, "M50 and G64 both use the P word"},
    {"F100 G2 I5 P2 M50", 12, "P2", 24, "M50 and G2 both use the P word"},
    {"G4 P1 G64", 4, "P1", 24, "G64 and G4 both use the P word"},
    {"G10 L2 P1 X1 M51", 8, "P1", 24, "M51 and G10 both use the P word"},
    {"F100 G5 X9 Y0 I1 J1 P1 Q1 M61", 24, "Q1", 24, "M61 and G5 both use the Q word"},
    {"M61 Q1 F100 G83 X1 Z-1 R1", 5, "Q1", 24, "M61 and G83 both use the Q word"},
    {"F100 G83 X1 Z-1 R1 Q1\nM61 Q2 X2", 5, "Q2", 24, "M61 and G83 both use the Q word"},
    {"F100 G82 X1 Z-1 R1 P1 G64", 20, "P1", 24, "G64 and G82 both use the P word"},
    {"F100 G81 X1 Z-1 R1\nX2 M66 P1 L2", 11, "L2", 24, "G81 and M66 both use the L word"},
    {"G43.1", 1, "G43.1", 26, "Z word missing"},
    {"G28.1 X1", 7, "X1", 31, "takes no axis words"},
    {"G53 X1", 1, "G53", 30, "G0 or G1"},
    {"G2 X1 I.5 F1\nG53 X1", 1, "G53", 30, "G2 is active"},
    {"G0 X1\nG53", 1, "G53", 26, "needs a target"},
    // cycles
    {"F100 G81", 6, "G81", 26, "a position and a depth"},
    {"F100 G81 X1 Z-1", 6, "G81", 28, "R word missing"},
    {"F100 G81 X1 R1", 6, "G81", 28, "Z word missing"},
    {"F100 G82 X1 R1 Z-1", 6, "G82", 28, "P word missing"},
    {"F100 G83 X1 R1 Z-1", 6, "G83", 28, "Q word missing"},
    {"F100 G83 X1 R1 Z-1 Q0", 20, "Q0", 33, "above 0"},
    {"F100 G83 X1 R1 Z-1 Q.00001", 20, "Q.00001", 33, "at most 100000 pecks"},
    {"G91 F100 G83 X1 R-1 Z-1 Q.001 L1000", 25, "Q.001", 33, "1000 holes"},
    {"F100 G81 X1 R-2 Z-1", 13, "R-2", 33, "below the bottom"},
    {"F100 G81 X1 R1 Z-1 L0", 20, "L0", 38, "from 1"},
    {"F100 G81 X1 R1 Z-1 L1.5", 20, "L1.5", 23, "integer"},
    {"F100 G81 X1 R1 Z-1 A5", 20, "A5", 36, "does not turn axes"},
    {"G81 X1 R1 Z-1", 1, "G81", 22, "F word missing"},
    {"G93 F1 G81 X1 R1 Z-1", 8, "G81", 22, "inverse time"},
    // limits
    {"G0 X500.1", 4, "X500.1", 15, "from -500 to 500"},
    {"G10 L2 P1 X10\nG0 X495", 4, "X495", 15, "the work offset is 10"},
    {"G20 G0 Y-20", 8, "Y-20", 15, "Y = -508 mm"},
    {"G0 A501", 4, "A501", 15, "degrees"},
    {"G91 G0 X300\nX300", 1, "X300", 15, "X = 600 mm"},
    {"G0 X499\nG2 Y2 J1 F9\nG2 X499 Y0 R-1.5", 1, "G2", 15, "this arc exceeds the travel"},
    {"G0 X499\nG3 I-1 F9\nG2 X499 I2", 1, "G2", 15, "X = 503 mm"},
    {"F1 G91 G81 X200 R0 Z-1 L3", 12, "X200", 15, "X = 600 mm"},
    {"F1 G81 X0 R600 Z-1", 11, "R600", 15, "Z = 600 mm"},
    {"F1 G81 X0 R6 Z-501", 14, "Z-501", 15, "Z = -501 mm"},
};

int last_line(const std::string& program) {
    return 1 + static_cast<int>(std::count(program.begin(), program.end(), '\n'));
}

}  // namespace

TEST(GcodeReader, RejectsWithLocationWordNumberAndSentence) {
    for (const RefusedLine& row : refused) {
        SCOPED_TRACE(row.program);
        const auto program = testing::read(row.program);
        ASSERT_EQ(program.problems.size(), 1u);
        const Problem& problem = program.problems[0];
        EXPECT_EQ(problem.location.line, last_line(row.program));
        EXPECT_EQ(problem.location.column, row.column) << problem.text();
        EXPECT_EQ(problem.word, row.word) << problem.text();
        EXPECT_EQ(static_cast<int>(problem.status), row.grbl) << problem.text();
        EXPECT_THAT(problem.message, HasSubstr(row.says));
        EXPECT_EQ(problem.file, "part.ngc");
    }
}

TEST(GcodeReader, RefusesProbingWithoutAProbe) {
    Settings settings = testing::machine();
    settings.probe = false;
    const auto program = testing::read("G38.2 Z-1 F10", settings);
    ASSERT_EQ(program.problems.size(), 1u);
    EXPECT_EQ(program.problems[0].status, GrblStatus::unsupported);
    EXPECT_THAT(program.problems[0].message, HasSubstr("no probe input"));
}

TEST(GcodeReader, ErrorTextNamesFileLineColumnAndRemedy) {
    const auto program = testing::read("G21\n  G1 X5\n");
    ASSERT_EQ(program.problems.size(), 1u);
    EXPECT_EQ(program.problems[0].text(),
              "part.ngc:2:3: F word missing: G1 needs a feed; write e.g. F600 (mm/min) on this line or before it");
}

TEST(GcodeReader, RefusesAxesThatTheMachineDoesNotHave) {
    const auto program = testing::read("G0 X1 A5\nG92 B0\n", testing::machine("XYZ"));
    ASSERT_EQ(program.problems.size(), 2u);
    EXPECT_EQ(program.problems[0].message,
              "A5: this machine has no A axis (it has X Y Z); take the word out or set the axis up");
    EXPECT_EQ(program.problems[1].word, "B0");
}

TEST(GcodeReader, RefusesALineOfMoreThan1024CharactersAndContinuesAfterIt) {
    const std::string long_comment = "(" + std::string(1022, 'x') + ")";
    ASSERT_EQ(long_comment.size(), max_line_length);
    const auto program = testing::read(long_comment + "\nG0 X1 " + std::string(100'000, ' ') + "\r\nG0 X2\n");
    ASSERT_EQ(program.problems.size(), 1u);
    EXPECT_EQ(program.problems[0].location, (TextPosition{2, 1025}));
    EXPECT_EQ(program.problems[0].status, GrblStatus::line_too_long);
    ASSERT_EQ(program.moves().size(), 1u);
    EXPECT_EQ(program.moves()[0].end[0], 2);
    EXPECT_EQ(program.moves()[0].line, 3);
}

TEST(GcodeReader, AfterAProblemNothingOfTheLineHasTakenEffect) {
    Interpreter interpreter(testing::machine());
    ASSERT_TRUE(interpreter.line("G1 X1 F60 G64 P.5 S100", 1));
    const char* bad[] = {"G20 G91 G18 G55 G93 F5 S7 T3 G0 X1 I1",
                         "G92 X5 I1",
                         "G10 L2 P1 X5 I3",
                         "G43.1 Z5 K1",
                         "G28 X5 R1",
                         "G61 M3 M8 X1000",
                         "G28.1 G0 X2000",
                         "M2 X900",
                         "G82 X1 R1 Z0",
                         "G2 X9 I1",
                         "T7 M6 X1 X1"};
    for (const char* line : bad) {
        SCOPED_TRACE(line);
        ASSERT_FALSE(interpreter.line(line, 2));
        EXPECT_EQ(interpreter.pull(), nullptr);
        EXPECT_EQ(interpreter.position(), (Point{1, 0, 0, 0, 0, 0}));
        EXPECT_EQ(interpreter.frame().offset, Point{});
        EXPECT_EQ(interpreter.frame().g28, Point{});
        const ModalState& modes = interpreter.modes();
        EXPECT_EQ(modes.motion, 10);
        EXPECT_EQ(modes.plane + modes.system + modes.inch + modes.incremental + modes.inverse_time + modes.flood, 0);
        EXPECT_EQ(modes.path, PathControl::continuous);
        EXPECT_EQ(modes.spindle, Spindle::off);
        EXPECT_EQ(modes.tolerance_mm, 0.5);
        EXPECT_EQ(modes.feed, 1);
        EXPECT_EQ(modes.speed_rpm, 100);
        EXPECT_EQ(modes.tool_selected, -1);
        EXPECT_FALSE(modes.ended);
    }
    ASSERT_TRUE(interpreter.line("X2", 3));
    const CanonCall* step = interpreter.pull();
    ASSERT_NE(step, nullptr);
    EXPECT_EQ(step->move.kind, MoveKind::feed);
    EXPECT_EQ(step->move.end[0], 2);
}

TEST(GcodeCheck, CollectsProblemsUpToANumber) {
    const std::string text = "G0 X1\nX\nX2\nM77\nY900\nX3\n";
    const ProgramCheck all = check_program(text, testing::machine(), 10, "a.ngc");
    ASSERT_EQ(all.problems.size(), 3u);
    EXPECT_EQ(all.problems[0].location, (TextPosition{2, 1}));
    EXPECT_EQ(all.problems[1].location, (TextPosition{4, 1}));
    EXPECT_EQ(all.problems[2].location, (TextPosition{5, 1}));
    EXPECT_EQ(all.moves, 3);
    EXPECT_EQ(all.lines, 6);
    EXPECT_EQ(all.max[0], 3);
    EXPECT_FALSE(all.more_problems);
    const ProgramCheck two = check_program(text, testing::machine(), 2);
    EXPECT_EQ(two.problems.size(), 2u);
    EXPECT_TRUE(two.more_problems);
}

TEST(GcodeCheck, RefusesAProgramWithoutAnyWord) {
    for (const char* text :
         {"", "\n\n", "; done\n", "(MSG,hello)", "(a part)\n\n%\n", "\xEF\xBB\xBF", "%\n%\nG1 X1 F100\n"}) {
        const ProgramCheck check = check_program(text, testing::machine(), 10, "a.ngc");
        ASSERT_EQ(check.problems.size(), 1u) << text;
        EXPECT_THAT(check.problems[0].text(), HasSubstr("a.ngc:1:1: the program is empty")) << text;
    }
    EXPECT_THAT(check_program("\n;\n", testing::machine(), 10).problems[0].message, HasSubstr("its 2 lines"));
    for (const char* text : {"M2", "G21", "#1=2", "/G0 X1", "%\nM2\n%\n", "G0 X0", "o1 if [0]\no1 endif\n"}) {
        const ProgramCheck check = check_program(text, testing::machine(), 10, "a.ngc");
        EXPECT_TRUE(check.problems.empty()) << text;
    }
    EXPECT_THAT(check_program("(never closed", testing::machine(), 10).problems[0].message, HasSubstr("this comment"));
}

TEST(GcodeSettings, RejectsNonFiniteNumbers) {
    Settings settings = testing::machine();
    EXPECT_TRUE(check_settings(settings));
    settings.g28[1] = 0.0 / 0.0;
    EXPECT_FALSE(check_settings(settings));
    settings = testing::machine();
    settings.limits[0].max_position = -501;
    ASSERT_FALSE(check_settings(settings));
    EXPECT_THAT(check_settings(settings).error().message, HasSubstr("axis X goes from -500 to -501"));
    settings = testing::machine();
    settings.path_tolerance_mm = -1;
    EXPECT_FALSE(check_settings(settings));
}

}  // namespace motionrack::control::gcode
