// Parameters and expressions of LinuxCNC's language.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/control/gcode/canon.hpp>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using ::testing::DoubleNear;
using ::testing::HasSubstr;

/// Returns the position of X after the program.
double x_after(const std::string& program) {
    const auto read = testing::read("G0 G21\n" + program, testing::machine("XYZABC", 1e8));
    EXPECT_TRUE(read.problems.empty()) << read.problems.front().text();
    const auto moves = read.moves();
    return moves.empty() ? std::nan("") : moves.back().end[0];
}

double value_of(const std::string& expression) {
    return x_after("X" + expression);
}

Problem problem_of(const std::string& program) {
    const auto read = testing::read(program);
    EXPECT_EQ(read.problems.size(), 1u) << program;
    return read.problems.empty() ? Problem{} : read.problems.front();
}

}  // namespace

TEST(GcodeExpressions, FollowOperatorPrecedenceFromTheLeft) {
    EXPECT_EQ(value_of("[1 + 2 * 3]"), 7);
    EXPECT_EQ(value_of("[[1 + 2] * 3]"), 9);
    EXPECT_EQ(value_of("[2 ** 3 ** 2]"), 64);
    EXPECT_EQ(value_of("[2 * 3 ** 2]"), 18);
    EXPECT_EQ(value_of("[-2 ** 2]"), 4);
    EXPECT_EQ(value_of("[10 - 4 - 3]"), 3);
    EXPECT_EQ(value_of("[24 / 4 / 3]"), 2);
    EXPECT_EQ(value_of("[7 MOD 4 * 2]"), 6);
    EXPECT_EQ(value_of("[-7 mod 4]"), 1);
    EXPECT_EQ(value_of("[1 + 1 EQ 2 AND 3 LT 4]"), 1);
    EXPECT_EQ(value_of("[1 OR 0 AND 0]"), 0) << "AND, OR and XOR are equally strong";
    EXPECT_EQ(value_of("[1 XOR 1]"), 0);
    EXPECT_EQ(value_of("[2 GT 1]"), 1);
    EXPECT_EQ(value_of("[2 GE 2]"), 1);
    EXPECT_EQ(value_of("[2 LE 1]"), 0);
    EXPECT_EQ(value_of("[2 NE 2.00001]"), 0) << "equal is what differs by less than 0.0001";
    EXPECT_EQ(value_of("[2 NE 2.001]"), 1);
    EXPECT_EQ(value_of("- [ 3 - - 1 ]"), -4);
}

TEST(GcodeExpressions, HaveAllFunctions) {
    EXPECT_EQ(value_of(" ABS[-3]"), 3);
    EXPECT_NEAR(value_of(" ACOS[0.5]"), 60, 1e-12);
    EXPECT_NEAR(value_of(" asin [0.5]"), 30, 1e-12);
    EXPECT_NEAR(value_of(" ATAN[1]/[-1]"), 135, 1e-12);
    EXPECT_NEAR(value_of(" COS[60]"), 0.5, 1e-15);
    EXPECT_NEAR(value_of(" EXP[1]"), 2.718281828459045, 1e-15);
    EXPECT_EQ(value_of(" FIX[-2.5]"), -3);
    EXPECT_EQ(value_of(" FUP[-2.5]"), -2);
    EXPECT_NEAR(value_of(" LN[10]"), 2.302585092994046, 1e-15);
    EXPECT_EQ(value_of(" ROUND[2.5]"), 3);
    EXPECT_EQ(value_of(" ROUND[-2.5]"), -3);
    EXPECT_NEAR(value_of(" SIN[30]"), 0.5, 1e-15);
    EXPECT_EQ(value_of(" SQRT[9]"), 3);
    EXPECT_NEAR(value_of(" TAN[45]"), 1, 1e-15);
    EXPECT_EQ(value_of("-SQRT[SQRT[16]]"), -2);
    EXPECT_EQ(value_of("[EXISTS[#<depth>] + 2 * EXISTS[#1]]"), 2);
}

TEST(GcodeExpressions, GiveWordsOfAllKindsTheirValues) {
    const auto read = testing::read("#1 = 1\nG#1 X[2] F[60 * 2]\nG[61 + .1]\nG91 G[#1 - 1] X-#1\nM[2 + #1] S[1e0]",
                                    testing::machine());
    ASSERT_EQ(read.problems.size(), 1u) << "1e0 is no number of G-code";
    const auto good = testing::read("#1 = 1\nG#1 X[2] F[60 * 2]\nG[61 + .1]\nG91 G[#1 - 1] X-#1\nM[2 + #1] S[10 * 10]",
                                    testing::machine());
    ASSERT_TRUE(good.problems.empty()) << good.problems.front().text();
    const auto moves = good.moves();
    ASSERT_EQ(moves.size(), 2u);
    EXPECT_EQ(moves[0].kind, MoveKind::feed);
    EXPECT_EQ(moves[0].feed, 2);
    EXPECT_EQ(moves[1].kind, MoveKind::rapid);
    EXPECT_EQ(moves[1].path, PathControl::exact_stop);
    EXPECT_EQ(moves[1].end[0], 1);
    EXPECT_EQ(good.steps.back().kind, CanonCallKind::spindle);
}

TEST(GcodeParameters, AreSetAfterTheWholeLineIsRead) {
    EXPECT_EQ(x_after("#3 = 15\n#3 = 6 X#3"), 15);
    EXPECT_EQ(x_after("#3 = 15\n#3 = 6\nX#3"), 6);
    EXPECT_EQ(x_after("#1 = 2 #2 = [#1 + 5]\nX#2"), 5) << "the second does not see the first";
    EXPECT_EQ(x_after("#1 = 2 #1 = 3\nX#1"), 3) << "the last one counts";
}

TEST(GcodeParameters, AreIndirectlyAddressable) {
    EXPECT_EQ(x_after("#1 = 2 #2 = 7\nX##1"), 7);
    EXPECT_EQ(x_after("#[1 + 1] = 7\nX#[4 / 2]"), 7);
    EXPECT_EQ(x_after("#<a b> = 3\nX[#<AB> * 2]"), 6) << "neither case nor blanks count in names";
    EXPECT_EQ(x_after("#<_all> = 3\nX#<_ALL>"), 3);
    EXPECT_EQ(x_after("X#77"), 0) << "a number that was never set is 0";
}

TEST(GcodeParameters, OfARejectedLineAreNotSet) {
    const auto read = testing::read("G0 #1 = 3\n#1 = 4 X9999\nX#1", testing::machine());
    ASSERT_EQ(read.problems.size(), 1u);
    EXPECT_EQ(read.moves().back().end[0], 3);
}

TEST(GcodeParameters, ReportWhereTheMachineIs) {
    EXPECT_EQ(x_after("G10 L2 P1 X10\nX5 Y7\nX[#5420 + #5421 + #5221]"), 32);
    EXPECT_EQ(x_after("G20 X1 Y2\nG21 Y[#5420]\nG20 X[#5421 * 2]"), 2 * 25.4);
    EXPECT_EQ(x_after("G55\nX[#5220]"), 2);
    EXPECT_EQ(x_after("X5\nG28.1\nX0\nX[#5161 + 1]"), 6);
    EXPECT_EQ(x_after("X5\nG30.1\nX0\nX[#5181 + 1]"), 6);
    EXPECT_EQ(x_after("X5\nG92 X1\nX[#5211 * 10 + #5210]"), 45);
    EXPECT_EQ(x_after("T3 M6\nX#5400"), 3);
}

TEST(GcodeParameters, ReportTheModesByName) {
    EXPECT_EQ(x_after("G10 L2 P2 X1\nG55 X2 Y3\nX[#<_x> + #<_y> * 10 + #<_abs_x> * 100]"), 333);
    EXPECT_EQ(x_after("X[#<_motion_mode> + #<_metric> + #<_absolute>]"), 2);
    EXPECT_EQ(x_after("G18\nX#<_plane>"), 180);
    EXPECT_EQ(x_after("G55\nX#<_coord_system>"), 550);
    EXPECT_EQ(x_after("F500 S900 M3\nX[#<_feed> + #<_rpm> + #<_spindle_on>]"), 1401);
    EXPECT_EQ(x_after("G20 F5\nX[#<_feed> / 25.4]"), 5);
    EXPECT_EQ(x_after("X#<_line>"), 2);
}

TEST(GcodeParameters, ThatAreFaultyAreReportedWithTheirLocation) {
    struct Row {
        const char* program;
        int column;
        const char* says;
    };
    const Row rows[] = {{"X#<depth>", 2, "#<depth> has no value yet"},
                        {"G0 X[1 / 0]", 8, "division by zero"},
                        {"G0 X[1 MOD 0]", 8, "MOD by zero"},
                        {"G0 X[1 + ]", 10, "expected a value"},
                        {"G0 X[1 + 2", 5, "']' is missing"},
                        {"G0 X[1 #2]", 8, "an operator or ']'"},
                        {"G0 X SQRT[-1]", 6, "0 or more"},
                        {"G0 X LN[0]", 6, "above 0"},
                        {"G0 X ACOS[2]", 6, "from -1 to 1"},
                        {"G0 X ATAN[2]", 13, "second bracket"},
                        {"G0 X[[-1] ** .5]", 11, "whole powers"},
                        {"G0 X[10 ** 400]", 9, "out of range"},
                        {"G0 X[10 ** 10]", 4, "evaluates to 1e+10"},
                        {"#5603 = 1", 1, "#1 to #5602"},
                        {"#0 = 1", 1, "#1 to #5602"},
                        {"#1.5 = 1", 1, "#1 to #5602"},
                        {"#5220 = 1", 1, "is a read-only value"},
                        {"#<_x> = 1", 1, "is a read-only value"},
                        {"#1", 1, "has no effect"},
                        {"#1 =", 5, "a value is missing"},
                        {"#<a = 1", 1, "'>' is missing"},
                        {"G0 X[EXISTS[1]]", 13, "needs a parameter"},
                        {"G[1.05] X1", 1, "not a known command"},
                        {"G0 X] Y1", 4, "has no number"}};
    for (const Row& row : rows) {
        const Problem problem = problem_of(row.program);
        EXPECT_EQ(problem.location.column, row.column) << row.program << ": " << problem.text();
        EXPECT_THAT(problem.message, HasSubstr(row.says)) << row.program;
    }
}

TEST(GcodeParameters, HaveALimitedNestingDepth) {
    const std::string deep = std::string(200, '[') + "1" + std::string(200, ']');
    EXPECT_THAT(problem_of("G0 X" + deep).message, HasSubstr("nested brackets"));
    EXPECT_THAT(problem_of("G0 X" + std::string(300, '#') + "1").message, HasSubstr("nested brackets"));
    EXPECT_THAT(problem_of("G0 X" + std::string(300, '-') + "#1").message, HasSubstr("nested brackets"));
}

TEST(GcodeParameters, AreShownByDebugAndPrint) {
    const auto read =
        testing::read("#1=2.5 #<hole>=7\n(DEBUG, at #1 and #<hole>, #<none>)\n(PRINT,%d#1 %.2f#1)\n(MSG,#1)\n(LOG,#1)",
                      testing::machine());
    ASSERT_TRUE(read.problems.empty());
    ASSERT_EQ(read.steps.size(), 4u);
    EXPECT_EQ(read.steps[0].kind, CanonCallKind::message);
    EXPECT_EQ(read.steps[2].kind, CanonCallKind::message);
    EXPECT_EQ(read.steps[2].text, "#1");
    EXPECT_EQ(read.steps[3].kind, CanonCallKind::comment);
    std::string out;
    const auto done = print_canon("#1=2.5 #<hole>=7\n(DEBUG, at #1 and #<hole>, #<none>)\n(PRINT,%d#1 %.2f#1)\n",
                                  testing::machine(), {}, [&](std::string_view line) { out += line; });
    ASSERT_TRUE(done);
    EXPECT_THAT(out, HasSubstr("MESSAGE(\" at 2.500000 and 7.000000, ######\")"));
    EXPECT_THAT(out, HasSubstr("MESSAGE(\"2 2.50\")"));
}

TEST(GcodeParameters, AreShownAsBeforeTheMoveOfTheirLine) {
    std::string out;
    ASSERT_TRUE(print_canon("G21 F100\nG1 X3\n#1=7 G1 X5 (PRINT,%d#5420 #1) (PRINT,#<_x>)\n(PRINT,#5420)\n",
                            testing::machine(), {}, [&](std::string_view line) { out += line; }));
    EXPECT_THAT(out, HasSubstr("MESSAGE(\"3 7\")"));
    EXPECT_THAT(out, HasSubstr("MESSAGE(\"3.000000\")"));
    EXPECT_THAT(out, HasSubstr("MESSAGE(\"5.000000\")"));
}

TEST(GcodeParameters, OfALineAreAllSetOrNone) {
    std::string names;
    for (int i = 0; i < 999; ++i) names += "#<n" + std::to_string(i) + ">=1\n";
    const auto read = testing::read(
        names + "#5=4 #<n3>=2 #<last>=3 #<too_many>=4\n#<last>=9\n#<_global>=1\n#<n3>=5\nG0 X[#5] Y[#<n3>] Z[#<last>]",
        testing::machine());
    ASSERT_EQ(read.problems.size(), 1u);
    EXPECT_EQ(read.problems[0].location.line, 1000);
    EXPECT_THAT(read.problems[0].message, HasSubstr("#<too_many> exceeds the limit of 1000 named parameters"));
    ASSERT_EQ(read.moves().size(), 1u);
    EXPECT_EQ(read.moves()[0].end[0], 0);
    EXPECT_EQ(read.moves()[0].end[1], 5);
    EXPECT_EQ(read.moves()[0].end[2], 9);
}

TEST(GcodeParameters, AreNotAcceptedFromSenders) {
    struct Row {
        const char* line;
        int column, grbl;
        const char* word;
        const char* says;
    };
    const Row rows[] = {{"G0 X#1", 4, 2, "X#1", "lines from a sender"},
                        {"G0 X[1+2]", 4, 2, "X[1+2]", "lines from a sender"},
                        {"#1=5", 1, 20, "#", "lines from a sender"},
                        {"G59.1", 1, 29, "G59.1", "six work systems"},
                        {"G10 L2 P7 X1", 8, 29, "P7", "six work systems"},
                        {"G10 L2 P1 X1 R5", 14, 36, "R5", "nothing on this line uses"},
                        {"G43 H1", 1, 20, "G43", "no tool table"},
                        {"G43.1 X1", 7, 37, "X1", "along Z only"},
                        {"G97", 1, 20, "G97", "rev/min"},
                        {"M48", 1, 20, "M48", "lines from a sender may use M0 to M30"},
                        {"O100 SUB", 1, 20, "O100", "O words"}};
    for (const Row& row : rows) {
        Interpreter interpreter(testing::machine());
        const auto done = interpreter.line(row.line, 1, Language::words);
        ASSERT_FALSE(done) << row.line;
        EXPECT_EQ(done.error().location.column, row.column) << row.line;
        EXPECT_EQ(static_cast<int>(done.error().status), row.grbl) << row.line;
        EXPECT_EQ(done.error().word, row.word) << row.line;
        EXPECT_THAT(done.error().message, HasSubstr(row.says));
    }
    Interpreter interpreter(testing::machine());
    EXPECT_TRUE(interpreter.line("#1 = 5 G0 X[#1 + 2]", 1, Language::expressions));
    EXPECT_FALSE(interpreter.line("O100 SUB", 1, Language::expressions));
}

/// An expression as text and its value by independent rules: every operation in its own brackets.
struct Bracketed {
    std::string text;
    double value = 0;
};

Bracketed random_expression(int depth) {
    const int kind = depth == 0 ? 0 : *rc::gen::inRange(0, 8);
    if (kind == 0) {
        const int number = *rc::gen::inRange(-40, 40);
        return {std::to_string(number), static_cast<double>(number)};
    }
    const Bracketed a = random_expression(depth - 1), b = random_expression(depth - 1);
    switch (kind) {
        case 1:
            return {"[" + a.text + " + " + b.text + "]", a.value + b.value};
        case 2:
            return {"[" + a.text + "-" + b.text + "]", a.value - b.value};
        case 3:
            return {"[" + a.text + "*" + b.text + "]", a.value * b.value};
        case 4:
            return {"[" + a.text + " LT " + b.text + "]", a.value < b.value ? 1.0 : 0.0};
        case 5:
            return {"ABS[" + a.text + "]", std::fabs(a.value)};
        case 6:
            return {"[" + a.text + " AND " + b.text + "]", a.value != 0 && b.value != 0 ? 1.0 : 0.0};
        default:
            return {"FIX[" + a.text + " / 7]", std::floor(a.value / 7)};
    }
}

RC_GTEST_PROP(GcodeExpressions, AgreeWithARefereeThatBracketsEverything, ()) {
    const Bracketed expression = random_expression(4);
    RC_PRE(std::fabs(expression.value) < 1e7);
    const auto read = testing::read("#1 = " + expression.text + "\nG0 X#1", testing::machine("X", 1e8));
    RC_ASSERT(read.problems.empty());
    RC_ASSERT(read.moves().back().end[0] == expression.value);
}

}  // namespace motionrack::control::gcode
