// M48 .. M53 and M62 .. M68: effects on the neighbouring moves, and refused uses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using ::testing::ElementsAre;
using testing::expect_refused;
using testing::Refused;

/// Returns the calls of a program in order, as "X1", "out P0 1 moving", "wait 2", "in P1 -1".
std::vector<std::string> reported(const std::string& program) {
    const auto read = testing::read("G21 G90 F600\n" + program);
    for (const Problem& problem : read.problems) ADD_FAILURE() << problem.text();
    std::vector<std::string> out;
    const auto number = [](double value) {
        std::string text = std::to_string(value);
        text.erase(text.find_last_not_of('0') + 1);
        return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
    };
    for (const CanonCall& step : read.steps) {
        const std::string port = (step.analog ? " E" : " P") + std::to_string(step.port) + ' ' + number(step.value);
        if (step.kind == CanonCallKind::output) out.push_back("out" + port + (step.with_motion ? " moving" : ""));
        if (step.kind == CanonCallKind::input) out.push_back("in" + port);
        if (step.kind == CanonCallKind::move)
            out.push_back(step.move.kind == MoveKind::dwell
                              ? "wait " + number(step.move.seconds)
                              : "X" + number(step.move.end[0]) + (step.overridable ? "" : " as written"));
    }
    return out;
}

}  // namespace

TEST(GcodePorts, OutputsKeepTheirOrderBetweenTheMoves) {
    EXPECT_THAT(reported("M62 P0\nG1 X1\nM63 P63 G1 X2\nM64 P2\nM65 P3 G0 X3\nM67 E0 Q-1.5\nM68 E1 Q2.25\nG1 X4"),
                ElementsAre("out P0 1 moving", "X1", "out P63 0 moving", "X2", "out P2 1", "out P3 0", "X3",
                            "out E0 -1.5 moving", "out E1 2.25", "X4"));
    EXPECT_THAT(reported("#1 = 5\nM64 P[#1 + 1]\nM68 E#1 Q[-#1 / 4]\nG0 X1"),
                ElementsAre("out P6 1", "out E5 -1.25", "X1"));
}

TEST(GcodePorts, OutputsKeepTheirOrderBesideAContour) {
    EXPECT_THAT(reported("G41.1 D2\nG1 X10\nM62 P1\nX20\nM65 P1 X30\nG40 G1 X40"),
                ElementsAre("X10", "out P1 1 moving", "X20", "out P1 0", "X30", "X40"));
}

TEST(GcodePorts, AnUnconnectedInputIsOff) {
    EXPECT_THAT(reported("M66 P1\nG0 X[#5399 + 10]"), ElementsAre("in P1 0", "X10"));
    EXPECT_THAT(reported("#5399 = 7\nM66 E3 L0 Q9\nG0 X[#5399 + 10]"), ElementsAre("in E3 0", "X10"));
    EXPECT_THAT(reported("M66 P1 L4 Q9\nG0 X[#5399 + 10]"), ElementsAre("in P1 0", "X10")) << "it is off already";
    for (const char* wait : {"L1", "L2", "L3"})
        EXPECT_THAT(reported(std::string("M66 P1 Q2.5 ") + wait + "\nG0 X[#5399 + 10]"),
                    ElementsAre("wait 2.5", "in P1 -1", "X9"))
            << wait;
}

TEST(GcodePorts, StateWhetherTheyNeedAStandstill) {
    const auto read = testing::read("M62 P1\nM67 E1 Q1\nM3 S1\nM49\nM64 P1\nM68 E1 Q1\nM66 P1\n");
    ASSERT_EQ(read.problems.size(), 0u);
    std::string rests;
    for (const CanonCall& step : read.steps) rests += needs_standstill(step) ? 'r' : '-';
    EXPECT_EQ(rests, "-----rrr");
}

TEST(GcodePorts, AreRefusedWithTheirLocation) {
    const Refused rows[] = {
        {"M62", 1, "P word missing: M62 needs the number of its output; write e.g. M62 P0"},
        {"M65 P64", 5, "the number of an output, from 0 to 63"},
        {"M64 P1.5", 5, "an integer"},
        {"M63 P-1", 5, "negative"},
        {"M62 P1 M63 P1", 8, "exclude each other"},
        {"M62 P1 Q3", 8, "nothing on this line uses"},
        {"M67 P1 Q1", 1, "E word missing: M67 needs the number of its output; write e.g. M67 E0 Q2.5"},
        {"M68 E1", 1, "Q word missing: M68 needs the value"},
        {"M67 E-1 Q1", 5, "from 0 to 63"},
        {"M66", 1, "P word missing: M66 needs the number of its input"},
        {"M66 P1 E1", 8, "one input"},
        {"M66 P1 L5 Q1", 8, "from 0 to 4"},
        {"M66 P1 L3", 1, "Q word missing: M66 waits for at most Q seconds"},
        {"M66 P1 L3 Q0", 11, "which must be above 0"},
        {"M66 P1 L3 Q-1", 11, "negative"},
        {"M66 E1 L3 Q1", 8, "waiting for an analog input is not possible"},
        {"G4 P1 M62", 4, "G4 and M62 both use the P word"},
        {"M62 P1 G64", 5, "G64 and M62 both use the P word"},
        {"M67 E1 G83 X1 Z-1 R1 Q2 F9", 22, "G83 and M67 both use the Q word"},
        {"G0 X1 E5", 7, "the machine has no extruder"},
        {"G0 X1e3", 4, "no exponent"},
        {"M64 P1 P2", 8, "second P word"}};
    expect_refused("", rows);
    EXPECT_FALSE(Interpreter(testing::machine()).line("M62 P1", 1)) << "a sender's line";
    EXPECT_FALSE(Interpreter(testing::machine()).line("G0 X1 E1", 1));
}

TEST(GcodePorts, ALineThatIsRefusedLeavesTheResultOfM66) {
    const auto read = testing::read("#5399 = 3\nM66 P1 X1\nG0 X#5399");
    EXPECT_EQ(read.problems.size(), 1u);
    ASSERT_EQ(read.moves().size(), 1u);
    EXPECT_EQ(read.moves()[0].end[0], 3);
}

TEST(GcodeOverrides, ApplyToMovesExceptThoseThatIgnoreThem) {
    EXPECT_THAT(reported("G1 X1\nM49\nX2\nG4 P1\nG0 X3\nM48\nX4\nM50 P0 X5\nM50\nX6\nM51 P0\nX7\nM53 P0 M8\nX8"),
                ElementsAre("X1", "X2 as written", "wait 1", "X3 as written", "X4", "X5 as written", "X6", "X7", "X8"));
    EXPECT_THAT(reported("M49\nG1 X1\nM2\nG1 X2"), ElementsAre("X1 as written")) << "the end gives them back";
    EXPECT_THAT(reported("M70 M49\nG1 X1\nM72\nG1 X2"), ElementsAre("X1 as written", "X2"));
    EXPECT_THAT(reported("o1 sub\nM73 M49\nG1 X1\no1 endsub\no1 call\nX2"), ElementsAre("X1 as written", "X2"));
    EXPECT_THAT(reported("M49\nG41.1 D2\nG1 X10\nM48\nX20\nG40 G1 X30"), ElementsAre("X10 as written", "X20", "X30"))
        << "moves that waited are those of their lines";
    EXPECT_THAT(reported("M49 G81 X1 Z-1 R1"),
                ElementsAre("X0 as written", "X1 as written", "X1 as written", "X1 as written"));
}

TEST(GcodeOverrides, CanBeReadByTheProgram) {
    const std::string read =
        "\nG0 X[#<_feed_override> + 2 * #<_speed_override> + 4 * #<_feed_hold> + 8 * #<_adaptive_feed>]";
    const auto value = [&](const std::string& line) { return reported(line + read).back(); };
    EXPECT_EQ(value(""), "X7");
    EXPECT_EQ(value("M49"), "X4 as written");
    EXPECT_EQ(value("M51 P0"), "X5");
    EXPECT_EQ(value("M53 P0"), "X3");
    EXPECT_EQ(value("M49\nM48\nM53 P0\nM53"), "X7");
}

TEST(GcodeOverrides, AreRestoredToTheSendersAfterAProgram) {
    Interpreter interpreter(testing::machine());
    ASSERT_TRUE(interpreter.line("M49", 1, Language::program));
    EXPECT_FALSE(interpreter.modes().feed_override);
    interpreter.reset_after_program();
    EXPECT_TRUE(interpreter.modes().feed_override && interpreter.modes().speed_override);
}

}  // namespace motionrack::control::gcode
