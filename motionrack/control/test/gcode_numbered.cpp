// Numbered programs: O100 .. M99, called by M98 P100 L3, as in LinuxCNC.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::Refused;
using testing::RefusedAt;
using testing::xs;

Problem problem_numbered(const std::string& program, const Settings& settings = testing::in_g0()) {
    const auto read = testing::read(program, testing::in_g0(settings));
    EXPECT_FALSE(read.problems.empty()) << program;
    return read.problems.empty() ? Problem{} : read.problems[0];
}

}  // namespace

TEST(GcodeNumbered, RunAsOftenAsTheyAreCalled) {
    EXPECT_THAT(xs("O0001 (PART)\nX1\nM98 P100\nX2\nM30\no100\nX5\nM99"), ElementsAre(1, 5, 2));
    EXPECT_THAT(xs("G91\nM98 P100 L3\nX10\nM2\nO0100\nX1\nM99"), ElementsAre(1, 2, 3, 13));
    EXPECT_THAT(xs("M98 P100 L0\nX1\nM2\nO100\nX5\nM99"), ElementsAre(1));
    EXPECT_THAT(xs("G91\nM98 P[50 * 2] L[1 + 1]\nM2\nN5 O100 (twice)\nX1\nN6 M99 (back)"), ElementsAre(1, 2));
    EXPECT_THAT(xs("G91\nM98 P1 L2\nM2\nO1\nX10\nM98 P2 L3\nM99\nO2\nX1\nM99"),
                ElementsAre(10, 11, 12, 13, 23, 24, 25, 26));
}

TEST(GcodeNumbered, MayReturnFromWithinLoopsAndConditions) {
    EXPECT_THAT(
        xs("G91\nM98 P1 L2\nX100\nM2\nO1\no2 repeat [5]\nX1\no3 if [#5420 GT 2]\nM99\no3 endif\no2 endrepeat\nM99"),
        ElementsAre(1, 2, 3, 4, 104));
    EXPECT_THAT(xs("G91\no9 repeat [2]\nM98 P1\no9 endrepeat\nM2\nO1\no2 repeat [5]\nX1\nM99\no2 endrepeat\nM99"),
                ElementsAre(1, 2));
}

TEST(GcodeNumbered, ShareTheNumbersOfTheirCallerButNotItsNames) {
    EXPECT_THAT(xs("#1=4\nM98 P1\nX#1\nM2\nO1\nX#1\n#1=9\nM99"), ElementsAre(4, 9));
    EXPECT_THAT(xs("#<a>=4 #<_kept>=1\nM98 "
                   "P1\nX#<a>\nX#<_kept>\nX#<_call_level>\nM2\nO1\n#<a>=7\n#<_kept>=8\nX#<_call_level>\nM99"),
                ElementsAre(1, 4, 8, 0));
    EXPECT_THAT(xs("o5 call [50]\nX#1\nM2\no5 sub\nM98 P1\nX#1\no5 endsub\nO1\n#1=[#1+1]\nM99"), ElementsAre(51, 0))
        << "the numbers are those of the sub that calls";
    EXPECT_THAT(xs("G90\nM98 P1\nX2\nM2\nO1\nM73 G91\nX1\nM99"), ElementsAre(1, 2)) << "M73 ends with the program";
}

TEST(GcodeNumbered, AreExecutedInlineWithoutACall) {
    EXPECT_THAT(xs("X1\nO5 (just a name)\nX2\nM2"), ElementsAre(1, 2));
    EXPECT_THAT(xs("X1\nM99\nX2"), ElementsAre(1)) << "M99 of the main program ends it";
    EXPECT_THAT(xs("M98 P1\nX9\nM2\nO1\nX1\nO2\nX2\nM99"), ElementsAre(1, 2, 9));
}

TEST(GcodeNumbered, MayBeInAFileOfTheirOwn) {
    Settings settings = testing::machine("XYZABC", 1e6);
    settings.subprogram = [](const std::string& name) -> Result<std::string> {
        if (name == "2000") return std::string("X66\nO2000\nX7\nX1e9\nM98 P3\nM99\nO3\nX3\nM99\n");
        if (name == "4") return std::string("X1\n");
        if (name == "6") return std::string("\nO6\nX1\n");
        return fail(ErrorKind::invalid_input, "there is no such file");
    };
    EXPECT_THAT(problem_numbered("M98 P2000", settings).file, "2000.ngc");
    settings.start_in_g0 = true;
    const auto read = testing::read("X1\nM98 P2000 L2\nX2\n", settings);
    std::vector<std::string> moves;
    for (const CanonCall& step : read.steps)
        moves.push_back(std::to_string(static_cast<int>(step.move.end[0])) + "@" + std::to_string(step.line));
    EXPECT_THAT(moves, ElementsAre("1@1", "7@2", "3@2", "7@2", "3@2", "2@3"));
    EXPECT_THAT(problem_numbered("M98 P4", settings).message, HasSubstr("M98 P4: 4.ngc has no O4"));
    EXPECT_THAT(problem_numbered("M98 P5", settings).message,
                HasSubstr("M98 P5: this program has no O5, and there is no such file"));
    const Problem open = problem_numbered("M98 P6", settings);
    EXPECT_EQ(open.file, "6.ngc");
    EXPECT_EQ(open.location.line, 2);
    EXPECT_THAT(open.message, HasSubstr("end it with M99"));
}

TEST(GcodeNumbered, AreRefusedWithTheirLocation) {
    const Refused rows[] = {{"M98", 1, "P word missing: M98 needs the number of a program"},
                            {"G0 X1 M98 P1", 7, "M98 needs a line"},
                            {"M98 P1 M3", 1, "M98 needs a line"},
                            {"M98 P1 X2", 1, "M98 needs a line"},
                            {"M98 P1 #1=2", 1, "M98 needs a line"},
                            {"M98 P1.5", 5, "an integer"},
                            {"M98 P-1", 5, "negative"},
                            {"M98 P1 L1.5", 8, "an integer"},
                            {"M98 P1 L-1", 8, "negative"},
                            {"M98 P7", 1, "M98 P7: this program has no O7"},
                            {"M99 P10", 1, "not to a line"},
                            {"G0 X1 M99", 7, "M99 needs a line"}};
    testing::expect_refused("M3\n", rows);
    const RefusedAt wholes[] = {{"M98 P1\nM2\no1 sub\no1 endsub", 1, "M98 P1: o1 sub is a sub; call it by o1 call"},
                                {"o1 call\nM2\nO1\nM99", 1, "o1 call: O1 is a numbered program; call it by M98 P1"},
                                {"M98 P1\nM2\nO1\nM99\nO1\nM99", 5, "line 3 has the same one"},
                                {"M98 P1\nM2\nO1\no2 if [1]\nO3\no2 endif\nM99", 5,
                                 "O3: a numbered program must not be nested, but o2 if of line 4 is open here"},
                                {"M98 P1\nM2\nX1\nO1\nX5\n", 4, "end it with M99"},
                                {"o1 sub\nM99\no1 endsub\no1 call", 2, "M99 ends a numbered program"},
                                {"M98 P1\nM2\nO1\nM98 P1\nM99", 4, "100 nested calls"}};
    testing::expect_refused_at(wholes, testing::in_g0());
    EXPECT_FALSE(Interpreter(testing::machine()).line("M98 P1", 1)) << "a sender's line";
    EXPECT_FALSE(Interpreter(testing::machine()).line("M98 P1", 1, Language::expressions));
}

TEST(GcodeNumbered, AProgramThatCallsWithoutEndIsStopped) {
    Settings settings = testing::machine("XYZABC", 1e6);
    settings.max_lines = 1000;
    const auto read = testing::read("M98 P1 L1000000000\nM2\nO1\nM3\nM99", settings);
    ASSERT_EQ(read.problems.size(), 1u);
    EXPECT_THAT(read.problems[0].message, HasSubstr("without an end"));
}

}  // namespace motionrack::control::gcode
