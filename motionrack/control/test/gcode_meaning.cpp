// Interpretation of programs: moves with all their fields, order of events, delimiters of the text.
#include <gtest/gtest.h>

#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/gcode/number.hpp>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

using testing::machine;
using testing::read;

TEST(GcodeReader, FillsAFeedMove) {
    const auto moves = read("G64 P.2\nG1 X1.5 Y-2 F600").moves();
    ASSERT_EQ(moves.size(), 1u);
    EXPECT_EQ(moves[0].kind, MoveKind::feed);
    EXPECT_EQ(moves[0].path, PathControl::continuous);
    EXPECT_EQ(moves[0].feed_mode, FeedMode::units_per_second);
    EXPECT_EQ(moves[0].line, 2);
    EXPECT_EQ(moves[0].feed, 10);
    EXPECT_EQ(moves[0].tolerance_mm, 0.2);
    EXPECT_EQ(moves[0].end, (Point{1.5, -2, 0, 0, 0, 0}));
}

TEST(GcodeReader, FillsArcsOfAllPlanesWithTheSignOfTheThirdAxis) {
    const auto moves = read("F60 G17 G3 X10 Z1 I5\nG18 G2 X20 Z1 I5 P3\nG19 G3 Y4 J2").moves();
    ASSERT_EQ(moves.size(), 3u);
    EXPECT_EQ(moves[0].kind, MoveKind::arc);
    EXPECT_EQ(moves[0].first, 0);
    EXPECT_EQ(moves[0].second, 1);
    EXPECT_EQ(moves[0].turns, 1);
    EXPECT_EQ(moves[0].centre_first, 5);
    EXPECT_EQ(moves[0].centre_second, 0);
    EXPECT_EQ(moves[1].first, 2);
    EXPECT_EQ(moves[1].second, 0);
    EXPECT_EQ(moves[1].turns, -3);
    EXPECT_EQ(moves[1].centre_first, 1);
    EXPECT_EQ(moves[1].centre_second, 15);
    EXPECT_EQ(moves[2].first, 1);
    EXPECT_EQ(moves[2].second, 2);
    EXPECT_EQ(moves[2].centre_first, 2);
    EXPECT_EQ(moves[2].centre_second, 1);
}

TEST(GcodeReader, ReadsTheFeedOfRotaryMovesInDegreesInEveryUnit) {
    const auto moves = read("G20 F60\nG1 A10\nX1 A20\nG21 B5").moves();
    ASSERT_EQ(moves.size(), 3u);
    EXPECT_EQ(moves[0].feed, 1);
    EXPECT_EQ(moves[0].end[3], 10);
    EXPECT_DOUBLE_EQ(moves[1].feed, 25.4);
    EXPECT_EQ(moves[2].feed, 1);
}

TEST(GcodeReader, InverseTimeIsPerSecond) {
    const auto moves = read("G93 G1 X1 F30\nG94 X2 F120").moves();
    ASSERT_EQ(moves.size(), 2u);
    EXPECT_EQ(moves[0].feed_mode, FeedMode::inverse_time);
    EXPECT_EQ(moves[0].feed, 0.5);
    EXPECT_EQ(moves[1].feed_mode, FeedMode::units_per_second);
    EXPECT_EQ(moves[1].feed, 2);
}

TEST(GcodeReader, PathControlGoesWithEachMove) {
    Settings settings = machine();
    settings.path_tolerance_mm = 0.03;
    const auto moves = read("G0 X1\nG61 X2\nG61.1 X3\nG64 P.5 X4\nG64 X5\nG20 G64 P1 X1\nG64 P0 X2", settings).moves();
    ASSERT_EQ(moves.size(), 7u);
    const PathControl paths[] = {PathControl::continuous, PathControl::exact_path, PathControl::exact_stop,
                                 PathControl::continuous, PathControl::continuous, PathControl::continuous,
                                 PathControl::continuous};
    for (int i = 0; i < 7; ++i) EXPECT_EQ(moves[i].path, paths[i]) << i;
    EXPECT_EQ(moves[0].tolerance_mm, 0.03);
    EXPECT_EQ(moves[3].tolerance_mm, 0.5);
    EXPECT_EQ(moves[4].tolerance_mm, 0.03);
    EXPECT_EQ(moves[5].tolerance_mm, 25.4);
    EXPECT_EQ(moves[6].tolerance_mm, 0.03) << "P0 is no tolerance";
}

TEST(GcodeReader, ReportsEventsInTheOrderInWhichTheyTakeEffect) {
    const auto program = read("G0 X1 M0 T4 M6 S500 M3 M7 M8 (hello) (MSG,look) G4 P2\nM9 M5\nM1\nM30\nG0 X9");
    const CanonCallKind kinds[] = {
        CanonCallKind::comment,        CanonCallKind::message, CanonCallKind::spindle_speed, CanonCallKind::tool_select,
        CanonCallKind::tool_change,    CanonCallKind::spindle, CanonCallKind::coolant,       CanonCallKind::move,
        CanonCallKind::move,           CanonCallKind::pause,   CanonCallKind::spindle,       CanonCallKind::coolant,
        CanonCallKind::optional_pause, CanonCallKind::end};
    ASSERT_TRUE(program.problems.empty());
    ASSERT_EQ(program.steps.size(), std::size(kinds));
    for (std::size_t i = 0; i < std::size(kinds); ++i) EXPECT_EQ(program.steps[i].kind, kinds[i]) << i;
    EXPECT_EQ(program.steps[0].text, "hello");
    EXPECT_EQ(program.steps[1].text, "look");
    EXPECT_EQ(program.steps[2].speed_rpm, 500);
    EXPECT_EQ(program.steps[3].tool, 4);
    EXPECT_EQ(program.steps[5].spindle, Spindle::clockwise);
    EXPECT_EQ(program.steps[5].speed_rpm, 500);
    EXPECT_TRUE(program.steps[6].mist && program.steps[6].flood);
    EXPECT_EQ(program.steps[7].move.kind, MoveKind::dwell);
    EXPECT_EQ(program.steps[7].move.seconds, 2);
    EXPECT_EQ(program.steps[7].move.end[0], 0);
    EXPECT_EQ(program.steps[8].move.end[0], 1);
    EXPECT_EQ(program.steps[10].spindle, Spindle::off);
    EXPECT_FALSE(program.steps[11].mist || program.steps[11].flood);
    EXPECT_EQ(program.steps[13].line, 4);
}

TEST(GcodeReader, BlockDeleteSkipsOrReadsLines) {
    Settings settings = machine();
    EXPECT_EQ(read("/G0 X1\n / G0 X2\nG0 X3", settings).moves().size(), 3u);
    settings.block_delete = true;
    const auto program = read("/G0 X1\n / what is this\nG0 X3", settings);
    EXPECT_TRUE(program.problems.empty());
    EXPECT_EQ(program.moves().size(), 1u);
}

TEST(GcodeReader, PercentSignsBeginAndEndAProgram) {
    EXPECT_EQ(read("%\nG0 X1\n%\nG0 X2").moves().size(), 1u);
    EXPECT_EQ(read("(name)\n\n%\nG0 X1\nX2").moves().size(), 2u);
    EXPECT_EQ(read("G0 X1\n%\nX2").moves().size(), 1u);
}

TEST(GcodeReader, SettingsGiveOffsetsAndReferencePoints) {
    Settings settings = machine();
    settings.work_offsets[1] = {10, 20, 30, 40, 50, 60};
    settings.g28 = {1, 2, 3, 4, 5, 6};
    settings.g30 = {-1, -2, -3, 0, 0, 0};
    settings.start = {7, 7, 7, 0, 0, 0};
    const auto moves = read("G55 G0 X1 A1\nG28 Z5\nG28\nG30", settings).moves();
    ASSERT_EQ(moves.size(), 5u);
    EXPECT_EQ(moves[0].end, (Point{11, 7, 7, 41, 0, 0}));
    EXPECT_EQ(moves[1].end, (Point{11, 7, 35, 41, 0, 0}));
    EXPECT_EQ(moves[2].end, (Point{11, 7, 3, 41, 0, 0}));
    EXPECT_EQ(moves[3].end, settings.g28);
    EXPECT_EQ(moves[4].end, settings.g30);
}

TEST(GcodeReader, StartsInG0WhereTheSettingsRequireIt) {
    Settings settings = machine();
    settings.start_in_g0 = true;
    const auto moves = read("X5", settings).moves();
    ASSERT_EQ(moves.size(), 1u);
    EXPECT_EQ(moves[0].kind, MoveKind::rapid);
}

TEST(GcodeReader, M2ResetsTheModalStateAfterTheMoves) {
    Interpreter interpreter(machine());
    ASSERT_TRUE(interpreter.line("G10 L2 P2 X5", 1));
    ASSERT_TRUE(interpreter.line("G55 G91 G18 G1 X1 F60 M3 M8 M2", 2));
    EXPECT_EQ(interpreter.modes().system, 1);
    while (interpreter.pull() != nullptr) {
    }
    const ModalState& modes = interpreter.modes();
    EXPECT_TRUE(modes.ended);
    EXPECT_EQ(modes.system + modes.plane + modes.incremental + modes.flood, 0);
    EXPECT_EQ(modes.motion, 10);
    EXPECT_EQ(modes.spindle, Spindle::off);
    EXPECT_EQ(interpreter.frame().offset, Point{});
}

TEST(GcodeReader, ArcsMayReachTheTravelLimitsButNotExceedThem) {
    EXPECT_TRUE(read("G0 X490 Y-10\nG3 X490 Y10 J10 F9").problems.empty());  // touches X500
    EXPECT_FALSE(read("G0 X490.001 Y-10\nG3 Y10 J10 F9").problems.empty());  // X500.001
    EXPECT_TRUE(read("G0 X490.001 Y-10\nG2 Y10 J10 F9").problems.empty());   // clockwise: does not reach X500
    EXPECT_TRUE(read("G0 X499 Y0\nG3 X489 Y10 I-10 F9").problems.empty());   // starts at its largest X
    EXPECT_FALSE(read("G0 X499 Y0\nG3 X489 Y10 Z1 I-10 J-1.1 F9").problems.empty());
}

TEST(GcodeReader, AFullTurnWhoseEndIsRoundedStaysWithinTheTravel) {
    EXPECT_TRUE(read("G0 X-480\nG2 X-479.996 I-9 F9").problems.empty());
    for (const char* turn : {"G2 X-489.996 I-10 F9", "G3 X-490.004 I-10 F9", "G2 X-489.996 I-10 P2 F9"})
        EXPECT_FALSE(read(std::string("G0 X-490\n") + turn).problems.empty()) << turn;
}

TEST(GcodeReader, AnArcWithinTheRadiusToleranceIsAccepted) {
    EXPECT_TRUE(read("F9 G2 X10.004 Y0 I5").problems.empty());
    EXPECT_FALSE(read("F9 G2 X10.012 Y0 I5").problems.empty());
    EXPECT_TRUE(read("F9 G2 X200.1 Y0 I100").problems.empty());  // 0.1 mm in 100 mm
    EXPECT_FALSE(read("F9 G2 X200.2 Y0 I100").problems.empty());
}

TEST(GcodeReader, CyclesOfManyHolesNeedNoStorage) {
    const ProgramCheck check = check_program("F60 G91 G99 G83 X.01 Z-1 R-1 Q.1 L10000", machine(), 5);
    EXPECT_TRUE(check.problems.empty());
    EXPECT_EQ(check.moves, 1 + 10'000 * (1 + 10 + 9 * 2 + 1));  // 1: down to R before the first hole
}

TEST(GcodeNumber, IsTheCorrectlyRoundedDouble) {
    const struct {
        const char* text;
        double value;
    } rows[] = {{"0", 0},
                {"-0.0", 0},
                {"12.345", 12.345},
                {"+.5", 0.5},
                {"5.", 5},
                {"-3.210", -3.21},
                {"0.1000000000000000055511151231257827", 0.1},
                {"123456789.123456789123456789", 123456789.123456789123456789},
                {"0.00000000000000000000000001", 1e-26},
                {"9007199.254740993", 9007199.254740993},
                {"90071992.54740993111", 90071992.54740993111},
                {"1 2 . 3\t4", 12.34},
                {"- 7", -7},
                {"000000000000000000000000000000012", 12},
                {"1000000000", 1e9}};
    for (const auto& row : rows) {
        const std::string text = row.text;
        const char* at = text.data();
        const Number number = scan_number(at, text.data() + text.size());
        EXPECT_EQ(number.fault, NumberFault::none) << text;
        EXPECT_EQ(number.value, row.value) << text;
        EXPECT_EQ(at, text.data() + text.size()) << text;
    }
}

TEST(GcodeArc, PassesTheExtremesBetweenItsEnds) {
    using Four = std::array<bool, 4>;
    EXPECT_EQ(extremes_passed({1, -1}, {1, 1}, true), (Four{true, false, false, false}));
    EXPECT_EQ(extremes_passed({1, -1}, {1, 1}, false), (Four{false, true, true, true}));
    EXPECT_EQ(extremes_passed({1, 1}, {1, -1}, true), (Four{false, true, true, true}));
    EXPECT_EQ(extremes_passed({-1, 0.1}, {-1, -0.1}, true), (Four{false, false, true, false}));
    EXPECT_EQ(extremes_passed({1, 0.1}, {0.1, 1}, true), (Four{false, false, false, false}));
}

TEST(GcodeProbing, IsAMoveThatStopsAtItsEnd) {
    const auto program = testing::read("G90 G64 F60\nG38.2 Z-10\nG38.3 Z-5\nG38.4 X4 Z0\nG38.5 X0\nY1\nG1 X5\n");
    ASSERT_TRUE(program.problems.empty()) << program.problems[0].text();
    const Probe kinds[] = {Probe::contact,    Probe::contact_if, Probe::release,
                           Probe::release_if, Probe::release_if, Probe::none};
    ASSERT_EQ(program.steps.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(program.steps[i].probe, kinds[i]) << i;
        EXPECT_EQ(program.steps[i].move.kind, MoveKind::feed);
        EXPECT_EQ(program.steps[i].move.path, i < 5 ? PathControl::exact_stop : PathControl::continuous);
        EXPECT_EQ(program.steps[i].move.feed, 1);
    }
}

TEST(GcodeProbing, TheNextLineStartsAtTheStopPosition) {
    Interpreter interpreter(testing::machine());
    ASSERT_TRUE(interpreter.line("G91 F60 G38.2 Z-10", 1));
    ASSERT_EQ(interpreter.pull()->probe, Probe::contact);
    interpreter.set_probe_result(true, {0, 0, -3, 0, 0, 0}, {0, 0, -3.125, 0, 0, 0});
    EXPECT_TRUE(interpreter.frame().probe_hit);
    EXPECT_EQ(interpreter.frame().probe[2], -3);
    ASSERT_TRUE(interpreter.line("G0 Z1", 2));
    EXPECT_EQ(interpreter.pull()->move.end[2], -2.125);
}

}  // namespace motionrack::control::gcode
