// O words: subprograms, conditions and loops, as in LinuxCNC.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "gcode_support.hpp"

namespace motionrack::control::gcode {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::RefusedAt;
using testing::xs;

std::vector<Problem> problems(const std::string& program, const Settings& settings = testing::in_g0()) {
    return testing::read(program, testing::in_g0(settings)).problems;
}

}  // namespace

TEST(GcodeFlow, BranchesGoWhereTheFirstConditionHolds) {
    const auto branch = [](int value) {
        return xs(
            "#1=" + std::to_string(value) +
            "\no1 if [#1 EQ 1]\nX1\no1 elseif [#1 EQ 2]\nX2\no1 elseif [#1 EQ 3]\nX3\no1 else\nX4\no1 endif\nX9\n");
    };
    EXPECT_THAT(branch(1), ElementsAre(1, 9));
    EXPECT_THAT(branch(2), ElementsAre(2, 9));
    EXPECT_THAT(branch(3), ElementsAre(3, 9));
    EXPECT_THAT(branch(4), ElementsAre(4, 9));
    EXPECT_THAT(xs("o1 if [0]\nX1\no1 endif\nX2"), ElementsAre(2));
    EXPECT_THAT(xs("o1 if [0]\no2 if [1]\nX1\no2 endif\no1 else\nX3\no1 endif\nX2"), ElementsAre(3, 2));
}

TEST(GcodeFlow, LoopsRepeatAsProgrammed) {
    EXPECT_THAT(xs("#1=0\no1 while [#1 LT 3]\nX#1\n#1=[#1+1]\no1 endwhile\nX9"), ElementsAre(0, 1, 2, 9));
    EXPECT_THAT(xs("o1 while [0]\nX1\no1 endwhile\nX9"), ElementsAre(9));
    EXPECT_THAT(xs("#1=5\no1 do\nX#1\n#1=[#1+1]\no1 while [#1 LT 5]\nX9"), ElementsAre(5, 9));
    EXPECT_THAT(xs("#1=3\no1 do\nX#1\n#1=[#1+1]\no1 while [#1 LT 6]\nX9"), ElementsAre(3, 4, 5, 9));
    EXPECT_THAT(xs("G91\no1 repeat [3]\nX1\no1 endrepeat\n"), ElementsAre(1, 2, 3));
    EXPECT_THAT(xs("o1 repeat [0]\nX1\no1 endrepeat\nX2"), ElementsAre(2));
    EXPECT_THAT(xs("o1 repeat [-3]\nX1\no1 endrepeat\nX2"), ElementsAre(2));
    EXPECT_THAT(xs("G91\no1 repeat [2]\no2 repeat [3]\nX1\no2 endrepeat\nX10\no1 endrepeat\n"),
                ElementsAre(1, 2, 3, 13, 14, 15, 16, 26));
}

TEST(GcodeFlow, BreakAndContinueMeanTheLoopWithTheirLabel) {
    EXPECT_THAT(xs("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 elseif [#1 EQ 5]\no1 break\no2 "
                   "endif\nX#1\no1 endwhile\nX9"),
                ElementsAre(1, 3, 4, 9));
    EXPECT_THAT(xs("#1=0\no1 do\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nX#1\no1 while [#1 LT 4]\nX9"),
                ElementsAre(1, 3, 4, 9));
    EXPECT_THAT(xs("#1=0\no1 repeat [4]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nX#1\no1 endrepeat\nX9"),
                ElementsAre(1, 3, 4, 9));
    EXPECT_THAT(xs("#1=0\no1 repeat [2]\n#1=[#1+1]\no2 repeat [5]\no3 if [1]\no1 continue\no3 endif\no2 endrepeat\no1 "
                   "endrepeat\nX#1"),
                ElementsAre(2))
        << "leaving an inner repeat by an outer continue forgets the inner one";
    EXPECT_THAT(
        xs("o1 repeat [2]\no2 repeat [5]\no1 break\no2 endrepeat\no1 endrepeat\nG91\no2 repeat [2]\nX1\no2 endrepeat"),
        ElementsAre(1, 2))
        << "a label may be used again later";
}

TEST(GcodeFlow, CallsHaveArgumentsAndReturnValues) {
    EXPECT_THAT(
        xs("o100 sub\nX#1\nX#2\nX#3\no100 endsub [#1 + #2]\n#1=7 #3=8\no100 call [1] [2]\nX#<_value>\nX#1\nX#3\n"),
        ElementsAre(1, 2, 0, 3, 7, 8))
        << "#1 to #30 are the call's own";
    EXPECT_THAT(xs("o<a> sub\n#31=5\nX[#<_value_returned>]\no<a> endsub\no<a> call\nX#31\nX#<_value_returned>\n"),
                ElementsAre(0, 5, 0));
    EXPECT_THAT(xs("o<A b> sub\no1 if [#1 GT 2]\no<ab> return [#1]\no1 endif\nX1\no<ab> endsub [0]\no<AB> call "
                   "[5]\nX#<_value>\no<ab> call [1]\nX#<_value>"),
                ElementsAre(5, 1, 0));
    EXPECT_THAT(xs("X1\nO100 CALL [2]\nX3\nM2\no100 sub\nX#1\no100 endsub\n"), ElementsAre(1, 2, 3))
        << "subs may follow the end";
    EXPECT_THAT(xs("#5=100\no#5 call [4]\no[#5 + 1] call\no100 sub\nX#1\no100 endsub\no101 sub\nX5\no101 endsub\n"),
                ElementsAre(4, 5));
    EXPECT_THAT(xs("o0100 sub\nX1\no100 endsub\no100 call"), ElementsAre(1));
}

TEST(GcodeFlow, KeepsNamedParametersLocalToACall) {
    EXPECT_THAT(xs("o1 sub\nX[EXISTS[#<a>]]\n#<a>=5 #<_g>=6\nX#<a>\no1 endsub\n#<a>=1\no1 call\nX#<a>\nX#<_g>"),
                ElementsAre(0, 5, 1, 6));
    EXPECT_THAT(xs("o1 sub\nX#<_call_level>\no2 if [#1 GT 1]\no1 call [#1 - 1]\no2 endif\no1 endsub\no1 call "
                   "[3]\nX#<_call_level>"),
                ElementsAre(1, 2, 3, 0));
}

TEST(GcodeFlow, RecursionHasItsOwnLoops) {
    // The sub calls itself from within a repeat.
    EXPECT_THAT(xs("G91\no1 sub\no2 if [#1 GT 0]\no3 repeat [2]\no1 call [#1 - 1]\no3 endrepeat\no2 else\nX1\no2 "
                   "endif\no1 endsub\no1 call [3]"),
                ::testing::SizeIs(8));
    EXPECT_THAT(
        xs("G91\no1 sub\no3 repeat [5]\nX1\no1 return\no3 endrepeat\no1 endsub\no9 repeat [3]\no1 call\no9 endrepeat"),
        ElementsAre(1, 2, 3));
}

TEST(GcodeFlow, LoadsSubprogramsFromFilesBesideTheProgram) {
    Settings settings = testing::machine("XYZABC", 1e6);
    std::vector<std::string> asked;
    settings.subprogram = [&asked](const std::string& name) -> Result<std::string> {
        asked.push_back(name);
        if (name == "hole")
            return std::string("%\no<hole> sub\nX#1\no<deeper> call [#1 + 1]\nX[#1 + 2]\no<hole> endsub\n%\n");
        if (name == "deeper") return std::string("(a comment)\no<deeper> sub\nX#1\nX1e9\no<deeper> endsub\n");
        if (name == "empty") return std::string("X1\n");
        return fail(ErrorKind::invalid_input, "there is no such file");
    };
    settings.start_in_g0 = true;
    const auto read = testing::read(
        "X0\no<hole> call [5]\no<HOLE> call [7]\nX1\no<none> call\no<empty> call\no<../up> call\n", settings);
    std::vector<double> at;
    std::vector<int> lines;
    for (const CanonCall& step : read.steps) at.push_back(step.move.end[0]), lines.push_back(step.line);
    EXPECT_THAT(at, ElementsAre(0, 5, 6, 7, 7, 8, 9, 1));
    EXPECT_THAT(lines, ElementsAre(1, 2, 2, 2, 3, 3, 3, 4)) << "moves of another file have the line of the call";
    EXPECT_THAT(asked, ElementsAre("hole", "deeper", "none", "empty")) << "each file is read once";
    ASSERT_EQ(read.problems.size(), 5u);
    EXPECT_EQ(read.problems[0].file, "deeper.ngc");
    EXPECT_EQ(read.problems[0].location.line, 4);
    EXPECT_THAT(read.problems[2].message, HasSubstr("there is no such file"));
    EXPECT_EQ(read.problems[2].location.line, 5);
    EXPECT_THAT(read.problems[3].message, HasSubstr("empty.ngc has no o<empty> sub"));
    EXPECT_THAT(read.problems[4].message, HasSubstr("cannot be a file in its folder"));
}

TEST(GcodeFlow, ReportsUnbalancedOWordsWithTheirLocation) {
    const RefusedAt rows[] = {{"X1\no1 if [1]\nX2", 2, "its o1 endif is missing"},
                              {"o1 endif", 1, "no o1 if is open here"},
                              {"o1 while [1]\no2 if [1]\no1 endwhile\no2 endif", 3, "o2 if of line 2 is open here"},
                              {"o1 sub\no2 sub\no2 endsub\no1 endsub", 2, "a sub must not be nested"},
                              {"o1 sub\no1 endsub\no1 sub\no1 endsub", 3, "line 1 has the same one"},
                              {"o1 break", 1, "it is not inside loop o1"},
                              {"o1 if [1]\no1 continue\no1 endif", 2, "it is not inside loop o1"},
                              {"o1 return", 1, "it is not inside sub o1"},
                              {"o1 sub\no2 return\no1 endsub", 2, "it is not inside sub o2"},
                              {"o1 if [1]\no1 else\no1 else\no1 endif", 3, "the last branch"},
                              {"o1 if [1]\no1 else\no1 elseif [1]\no1 endif", 3, "the last branch"},
                              {"o1 do\nX1", 1, "its o1 while is missing"},
                              {"o1 repeat [1]\nX1", 1, "its o1 endrepeat is missing"},
                              {"X1\no1 loop", 2, "'loop' is not valid after an O word"},
                              {"O<part> (PART)", 1, "has no effect alone"},
                              {"o<a call", 1, "'>' is missing"},
                              {"o call", 1, "needs a number or a name"},
                              {"o1 if [1]\no1 endif X5", 2, "only a comment"},
                              {"o#1 if [1]", 1, "only a call"}};
    testing::expect_refused_at(rows, testing::in_g0());
    EXPECT_EQ(problems("o1 endif\no2 endif\no3 foo\n").size(), 3u) << "all of them are told";
    EXPECT_THAT(problems("X1 o1 if [1]")[0].message, HasSubstr("must be first on its line"));
}

TEST(GcodeFlow, ReportsFaultyOWordsAndContinues) {
    const auto read = testing::read(
        "G0\no1 if [1 / 0]\nX1\no1 else\nX2\no1 endif\no2 while [#<no>]\nX3\no2 endwhile\no3 call\no4 repeat "
        "[]\nX4\no4 endrepeat\no5 if\no5 endif\n"
        "o6 if [1] [2]\no6 endif\no7 if [1] 2\no7 endif\nX9");
    ASSERT_EQ(read.problems.size(), 7u);
    EXPECT_THAT(read.problems[0].message, HasSubstr("division by zero"));
    EXPECT_EQ(read.problems[0].location.line, 2);
    EXPECT_EQ(read.problems[0].location.column, 10);
    EXPECT_THAT(read.problems[1].message, HasSubstr("has no value yet"));
    EXPECT_THAT(read.problems[2].message, HasSubstr("no o3 sub"));
    EXPECT_THAT(read.problems[4].message, HasSubstr("needs a value in brackets"));
    EXPECT_THAT(read.problems[5].message, HasSubstr("takes one value"));
    EXPECT_THAT(read.problems[6].message, HasSubstr("values in brackets"));
    ASSERT_EQ(read.moves().size(), 1u);
    EXPECT_EQ(read.moves()[0].end[0], 9);
}

TEST(GcodeFlow, ThatNeverEndsIsStopped) {
    Settings settings = testing::machine();
    settings.max_lines = 1000;
    for (const char* program : {"o1 while [1]\no1 endwhile", "o1 do\no1 while [1]",
                                "o1 repeat [1000000000]\no1 endrepeat", "o1 while [1]\nX1\nX2\no1 endwhile"}) {
        const auto found = problems(program, settings);
        ASSERT_EQ(found.size(), 1u) << program;
        EXPECT_THAT(found[0].message, ::testing::ContainsRegex("executed 100[0-9] lines"));
    }
    const auto deep = problems("o1 sub\no1 call\no1 endsub\no1 call", settings);
    ASSERT_EQ(deep.size(), 1u);
    EXPECT_THAT(deep[0].message, HasSubstr("100 nested calls"));
    EXPECT_TRUE(problems("o1 repeat [200]\nX1\nX2\no1 endrepeat", settings).empty());
}

TEST(GcodeFlow, StopsAProgramThatDrillsWithoutEnd) {
    Settings settings = testing::machine();
    settings.max_steps = 100'000;
    const std::string drills = "F100 G99\no1 repeat [#1]\nG81 X1 Z-1 R1 L1000\no1 endrepeat\nG80\nM2";
    const auto found = problems("#1=1000\n" + drills, settings);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_THAT(found[0].message, ::testing::ContainsRegex("have made 10[0-9]+ moves"));
    EXPECT_TRUE(problems("#1=20\n" + drills, settings).empty());
}

TEST(GcodeFlow, WithManyBranchesInALoopIsStopped) {
    Settings settings = testing::machine();
    settings.max_lines = 10'000;
    std::string branches = "o1 while [1]\no2 if [0]\n";
    for (int i = 0; i < 1000; ++i) branches += "o2 elseif [0]\n";
    branches += "o2 endif\no1 endwhile\n";
    const auto found = problems(branches, settings);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_THAT(found[0].message, ::testing::ContainsRegex("executed 1[0-9][0-9][0-9][0-9] lines"));
}

TEST(GcodeFlow, ChecksALineOnceHoweverOftenItIsExecuted) {
    const ProgramCheck check =
        check_program("G0\no1 repeat [100]\nX9999\nY1\no1 endrepeat\nX1\nM2\n", testing::machine(), 20);
    ASSERT_EQ(check.problems.size(), 1u);
    EXPECT_EQ(check.problems[0].location.line, 3);
    EXPECT_EQ(check.lines, 7);
    EXPECT_EQ(check.moves, 101);
    EXPECT_TRUE(check.ended);
}

TEST(GcodeFlow, AcceptsOWordsAfterLineNumbersAndSlashes) {
    EXPECT_THAT(xs("N10 o1 if [1] (comment)\nX1\nN20 o1 endif ; over\n/o2 repeat [2]\nX2\n/o2 endrepeat\n"),
                ElementsAre(1, 2, 2));
    EXPECT_THAT(xs("(pocket) o1 repeat [2] (twice)\nX1\n(so much)N5(for that) o1 endrepeat\n"), ElementsAre(1, 1));
    Settings settings = testing::machine();
    settings.block_delete = true;
    EXPECT_THAT(xs("/o2 repeat [2]\nX2\n/o2 endrepeat\n", settings), ElementsAre(2));
    EXPECT_THAT(xs("%\nX1\no1 if [1]\nX2\no1 endif\n%\no1 endif\n"), ElementsAre(1, 2))
        << "what is behind the closing % is no program";
}

/// Returns the lines with reported problems, in order.
std::vector<std::int32_t> refused_lines(const std::string& text) {
    std::vector<std::int32_t> lines;
    for (const Problem& problem : check_program(text, testing::machine(), 100, "f").problems)
        lines.push_back(problem.location.line);
    return lines;
}

TEST(GcodeFlow, EndsAtTheSamePercentSignWhateverIsRefused) {
    EXPECT_THAT(refused_lines("o1 call\n%t\no\n"), ElementsAre(1, 2));
    EXPECT_THAT(refused_lines("G1000\n%\nM98 P0\no\n"), ElementsAre(1));
    EXPECT_THAT(refused_lines("%\nM98 P7\n%\no\n"), ElementsAre(2));
    EXPECT_THAT(refused_lines("(pocket) G1000\n(end) %\no1 if\n"), ElementsAre(1));
    EXPECT_THAT(refused_lines("(pocket)\n ; its name\n\n (more) %\nG1000\no1 if\n"), ElementsAre(5, 6));
    EXPECT_THAT(xs("(pocket) G0 X1\n%\no1 rubbish\n"), ElementsAre(1));
}

/// A random program of nested loops and branches, with the result of a reference that executes it independently.
struct Scripted {
    std::string text;
    std::vector<double> out;
};

void script(Scripted& made, int depth, int& label, bool live) {
    const int parts = *rc::gen::inRange(1, 4);
    for (int i = 0; i < parts; ++i) {
        const int kind = depth == 0 ? 0 : *rc::gen::inRange(0, 4);
        const std::string o = "o" + std::to_string(++label) + " ";
        if (kind == 0) {
            const int x = *rc::gen::inRange(0, 100);
            made.text += "X" + std::to_string(x) + "\n";
            if (live) made.out.push_back(x);
            continue;
        }
        const int choice = *rc::gen::inRange(0, 3);
        if (kind == 1) {
            made.text += o + "if [" + std::to_string(choice) + " EQ 1]\n";
            script(made, depth - 1, label, live && choice == 1);
            made.text += o + "else\n";
            script(made, depth - 1, label, live && choice != 1);
            made.text += o + "endif\n";
        } else if (kind == 2) {
            made.text += o + "repeat [" + std::to_string(choice) + "]\n";
            const std::size_t before = made.out.size();
            script(made, depth - 1, label, live && choice > 0);
            const std::vector<double> once(made.out.begin() + static_cast<std::ptrdiff_t>(before), made.out.end());
            for (int k = 1; k < choice; ++k) made.out.insert(made.out.end(), once.begin(), once.end());
            made.text += o + "endrepeat\n";
        } else {
            const std::string count = "#<n" + std::to_string(label) + ">";
            made.text += count + " = 0\n" + o + "while [" + count + " LT " + std::to_string(choice) + "]\n";
            const std::size_t before = made.out.size();
            script(made, depth - 1, label, live && choice > 0);
            const std::vector<double> once(made.out.begin() + static_cast<std::ptrdiff_t>(before), made.out.end());
            for (int k = 1; k < choice; ++k) made.out.insert(made.out.end(), once.begin(), once.end());
            made.text += count + " = [" + count + " + 1]\n" + o + "endwhile\n";
        }
    }
}

RC_GTEST_PROP(GcodeFlow, RunsRandomProgramsAsTheRefereeDoes, ()) {
    Scripted made;
    int label = 0;
    script(made, 3, label, true);
    Settings settings = testing::machine();
    settings.start_in_g0 = true;
    const auto read = testing::read(made.text, settings);
    RC_ASSERT(read.problems.empty());
    std::vector<double> at;
    for (const Move& move : read.moves()) at.push_back(move.end[0]);
    RC_ASSERT(at == made.out);
}

}  // namespace motionrack::control::gcode
