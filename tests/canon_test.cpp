// `motionrack canon`, and programs in LinuxCNC's language from the command line.
#include <gmock/gmock.h>

#include <regex>
#include <sstream>
#include <string>

#include "ran.hpp"

namespace motionrack {
namespace {

using testing::HasSubstr;

class CanonCommand : public InFolder {};

TEST_F(CanonCommand, PrintsOneCallALine) {
    write("part.ngc", "G21 G90 G10 L2 P1 X1 R90\n#1 = 2.5\nG0 X#1 Y[#1 * 2]\nG1 F60 X0\nG4 P.5\nM2\n");
    const Ran ran = motionrack("canon part.ngc");
    EXPECT_EQ(ran.code, 0) << ran.out;
    const std::regex call(R"([A-Z][A-Z0-9_]*\(.*\))");
    std::istringstream lines(ran.out);
    for (std::string line; std::getline(lines, line);) EXPECT_TRUE(std::regex_match(line, call)) << line;
    EXPECT_THAT(
        ran.out,
        HasSubstr("\nSET_G5X_OFFSET(1, 1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\nSET_XY_ROTATION(90.0000)\n"
                  "STRAIGHT_TRAVERSE(2.5000, 5.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"));
    EXPECT_THAT(motionrack("canon --numbered part.ngc").out,
                HasSubstr("    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)\n"));
}

TEST_F(CanonCommand, ReportsARefusedProgramByItsExitCode) {
    write("part.ngc", "G21 G0 X1\nG0 X[1 / 0]\n");
    const Ran ran = motionrack("canon part.ngc");
    EXPECT_NE(ran.code, 0);
    EXPECT_THAT(ran.out, HasSubstr("STRAIGHT_TRAVERSE(1.0000"));
    EXPECT_THAT(ran.out, HasSubstr("part.ngc:2:8: division by zero"));
    write("loop.ngc", "o1 while [1]\no1 endwhile\n");
    EXPECT_NE(motionrack("canon loop.ngc").code, 0);
    write("open.ngc", "o1 if [1]\n");
    EXPECT_THAT(motionrack("check open.ngc").out, HasSubstr("open.ngc:1:1: o1 if: its o1 endif is missing"));
}

TEST_F(CanonCommand, TakesAToolTable) {
    write("part.ngc", "G21 G90 T2 M6\nG43 G0 Z1\nM2\n");
    write("tools.tbl", "T2 P1 Z12.5 D6 ;end mill\n");
    const Ran ran = motionrack("canon part.ngc -t tools.tbl --machine");
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_THAT(ran.out,
                HasSubstr("USE_TOOL_LENGTH_OFFSET(0.0000 0.0000 12.5000, 0.0000 0.0000 0.0000, 0.0000 0.0000 0.0000)"));
    EXPECT_THAT(ran.out, HasSubstr("STRAIGHT_TRAVERSE(0.0000, 0.0000, 13.5000"));
    EXPECT_NE(motionrack("canon part.ngc").code, 0);
    EXPECT_EQ(motionrack("check part.ngc --tools tools.tbl").code, 0);
    write("bad.tbl", "T2 P1\nZ5\n");
    const Ran bad = motionrack("canon part.ngc -t bad.tbl");
    EXPECT_NE(bad.code, 0);
    EXPECT_THAT(bad.out, HasSubstr("bad.tbl:2:1: the line has no tool number"));
}

TEST_F(CanonCommand, FindsSubprogramsBesideTheProgram) {
    std::filesystem::create_directories(folder / "parts");
    write("parts/part.ngc", "G21 G90\no<hole> call [5]\nM2\n");
    write("parts/hole.ngc", "o<hole> sub\nG0 X#1\nG0 X9999\no<hole> endsub\n");
    EXPECT_THAT(motionrack("canon parts/part.ngc").out, HasSubstr("STRAIGHT_TRAVERSE(5.0000"));
    EXPECT_THAT(motionrack("check parts/part.ngc").out, HasSubstr("hole.ngc:3:4: X9999 leads to"));
    write("parts/hole.ngc", "o<hole> sub\nG0 X#1\no<hole> endsub\n");
    const Ran ran = motionrack("run parts/part.ngc --no-report");
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_THAT(motionrack("canon - < parts/part.ngc").out, HasSubstr("no folder to search for its file"));
    std::filesystem::remove(folder / "parts/hole.ngc");
    const Ran missing = motionrack("check parts/part.ngc");
    EXPECT_THAT(missing.out, HasSubstr("was not found beside it"));
    EXPECT_EQ(missing.code, 2);
}

TEST_F(CanonCommand, DistinguishesAnUnreadableSubprogramFromAWrongOne) {
    write("part.ngc", "G21 G90\no<hole> call [5]\nM2\n");
    std::filesystem::create_directories(folder / "hole.ngc");
    for (const std::string command : {"canon", "check", "run --no-report"}) {
        const Ran ran = motionrack(command + " part.ngc");
        EXPECT_EQ(ran.code, 5) << command;
        EXPECT_THAT(ran.out, HasSubstr("hole.ngc cannot be read: it is a folder"));
    }
}

}  // namespace
}  // namespace motionrack
