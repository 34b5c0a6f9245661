// The programs in the description of the DataBoard 4002, executed as printed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <tests/ran.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

namespace motionrack {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path host_examples = source_root / "examples";

std::string run_again(const std::string& folder, const std::string& ran) {
    return "make it anew: examples/" + folder + "/run > examples/" + folder + "/expected.txt\n" + ran;
}

class OldHosts : public InFolder {
  protected:
    /// Writes the listing to a file and returns the output of the command.
    Ran about(const std::string& command, const std::string& name, const std::string& listing) const {
        write(name, listing);
        return shell(command + " " + name);
    }
    /// Runs the script `run` of an example with stubs that install and build nothing; its messages
    /// are in the file errors.
    Ran by_script(const std::string& host, const std::string& program, const std::string& arguments) const {
        const std::string built = "tree/build/release/examples/" + host;
        shell("rm -rf tree && mkdir -p tree/cmake tree/examples " + built + " && cp -r examples/" + host +
              " tree/examples && ln -s " + program + " " + built);
        write("tree/cmake/setup.sh", R"(run_packages=(some) release_options=(-DRELEASE=ON)
need_packages() { printf 'packages: %s\n' "$*" >&2; }
build_in() { printf 'built: %s\n' "$*" >&2; }
)");
        return run_in(folder, "tree/examples/" + host + "/run " + arguments, "errors");
    }
};

// ---- BASIC

TEST_F(OldHosts, ThePrintedBasicProgramPrintsTheExpectedOutput) {
    const Ran ran = run_in(host_examples / "basic_host", MOTIONRACK_BASIC_EXAMPLE " demo4002.bas 2 c1.esr 260 265");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(host_examples / "basic_host" / "expected.txt")) << run_again("basic_host", ran.out);
}

TEST_F(OldHosts, TheBasicScriptBuildsAndRunsThePrintedProgramOrTheGivenOne) {
    const Ran ran = by_script("basic_host", MOTIONRACK_BASIC_EXAMPLE, "");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(host_examples / "basic_host" / "expected.txt"));
    EXPECT_THAT(text_of(folder / "errors"), HasSubstr("built: build/release example_basic_host -DRELEASE=ON"));
    const Ran given = by_script("basic_host", MOTIONRACK_BASIC_EXAMPLE, "demo4002.bas 1");
    EXPECT_EQ(given.out, run_in(host_examples / "basic_host", MOTIONRACK_BASIC_EXAMPLE " demo4002.bas 1").out);
    EXPECT_NE(given.out, ran.out);
}

TEST_F(OldHosts, TheBasicInterpreterNamesTheLineOfAMistake) {
    struct Case {
        const char* listing;
        const char* said;
    };
    for (const Case& c : {Case{"10 WHILE 1\n20 A=1\n", "p.bas: line 10: WHILE has no WEND"},
                          Case{"10 WEND\n", "line 10: WEND has no WHILE"},
                          Case{"10 FOR I=1 TO 2\n20 WEND\n", "line 20: WEND has no WHILE"},
                          Case{"10 DEF FNA\n20 RETURN 1\n", "line 10: DEF has no FNEND"},
                          Case{"20 A=1\n10 A=2\n", "line 20: line 10 follows"},
                          Case{"10 A=1\nPRINT\n", "line 10: the line behind it has no number"},
                          Case{"10 ; \"A\n", "line 10: a text has no second quote"},
                          Case{"10 A=1?2\n", "line 10: the character '?'"},
                          Case{"10 DATA 1,,2\n", "line 10: DATA has something"},
                          Case{"10 A=70000\n", "line 10: a number is greater than 65535"},
                          Case{"10 A=300*300\n", "line 10: the number 90000 is outside -32768 to 32767"},
                          Case{"10 A=1/(2-2)\n", "line 10: a number is divided by 0"},
                          Case{"10 A=\"B\"\n", "line 10: A is a number and was given a text"},
                          Case{"10 READ A\n", "line 10: READ has found no more DATA"},
                          Case{"10 RESTORE 15\n20 DATA 1\n", "line 10: line 15 does not exist"},
                          Case{"10 A=FNB(1)\n", "line 10: FNB is not defined"},
                          Case{"10 DEF FNB\n20 RETURN FNB\n30 FNEND\n40 A=FNB\n", "line 20: more than 64 functions"},
                          Case{"10 DEF FNB(X)\n20 RETURN X\n30 FNEND\n40 A=FNB\n", "line 40: FNB has 1 parameters"},
                          Case{"10 OUT 1\n", "line 10: ',' is missing"},
                          Case{"10 A=INP(300)\n", "line 10: INP has the port 300"},
                          Case{"10 A=((((((((((((((((((1))))))))))))))))))\n", "line 10: more than 16 brackets"},
                          Case{"10 GOTO 30\n", "line 10: line 30 does not exist"},
                          Case{"10 RETURN\n", "line 10: RETURN has no GOSUB"},
                          Case{"10 WHILE 1 : WEND\n", "The program has put nothing on its screen for 1000 s"},
                          Case{"", "could not be read, or is empty"}}) {
        const Ran ran = about(MOTIONRACK_BASIC_EXAMPLE, "p.bas", c.listing);
        EXPECT_EQ(ran.code, 1) << c.listing;
        EXPECT_THAT(ran.out, HasSubstr(c.said)) << c.listing;
    }
}

TEST_F(OldHosts, TheBasicInterpreterCalculatesAndJumps) {
    const Ran ran = about(MOTIONRACK_BASIC_EXAMPLE, "p.bas",
                          "10 DEF FNTwice(X)\n20 RETURN X*2\n30 FNEND\n"
                          "40 X=3 : ; FNTwice(4)+X ! the parameter is the function's own\n"
                          "50 FOR I=3 TO 1 STEP -1 : ; I; : NEXT I : ;\n"
                          "60 FOR I=2 TO 1 : ; \"NOT\" : NEXT I\n"
                          "70 GOSUB 100 : IF 1=2 THEN ; \"NOT\" ELSE ; -7/2\n"
                          "80 RESTORE 120 : READ A,B$ : ; A B$ CHR$(65) ASCII(\"a\")\n"
                          "90 ; SWAP%(1200) : ; (NOT 5 AND 7) : ; \"A\"<\"B\" : END\n"
                          "100 ; 255 AND 15 OR 16\n110 RETURN\n120 DATA -1,\"MM\"\n");
    EXPECT_EQ(ran.code, 0) << ran.out;
    for (const char* said : {"  11 ", "  3 ", "  31 ", "  -3 ", "  -1MMA97 ", "  -20476 ", "  2 ", "  -1 "})
        EXPECT_THAT(ran.out, HasSubstr(said));
    EXPECT_THAT(ran.out, testing::Not(HasSubstr("NOT")));
}

// ---- assembler

#ifdef MOTIONRACK_Z80_EXAMPLE

TEST_F(OldHosts, ThePrintedZ80ProgramPrintsTheExpectedOutput) {
    const Ran ran = run_in(host_examples / "z80_host", MOTIONRACK_Z80_EXAMPLE " run demo4002.asm 1 c1.esr 20 25");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(host_examples / "z80_host" / "expected.txt")) << run_again("z80_host", ran.out);
}

TEST_F(OldHosts, TheZ80ScriptBuildsAndRunsThePrintedProgramOrTheGivenOne) {
    const Ran ran = by_script("z80_host", MOTIONRACK_Z80_EXAMPLE, "");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(host_examples / "z80_host" / "expected.txt"));
    EXPECT_THAT(text_of(folder / "errors"),
                HasSubstr("libz80ex-dev\nbuilt: build/release example_z80_host -DRELEASE=ON"));
    const Ran given = by_script("z80_host", MOTIONRACK_Z80_EXAMPLE, "demo4002.asm 1");
    EXPECT_EQ(given.out, run_in(host_examples / "z80_host", MOTIONRACK_Z80_EXAMPLE " run demo4002.asm 1").out);
    EXPECT_NE(given.out, ran.out);
}

TEST_F(OldHosts, AnotherAssemblerMakesTheSameBytesOfTheZ80Program) {
    const std::string listing = (host_examples / "z80_host/demo4002.asm").string(), host = MOTIONRACK_Z80_EXAMPLE;
    const Ran ran = shell(host + " zilog " + listing + " > a.z80 && z80asm -o z80asm.bin a.z80 && " + host + " bytes " +
                          listing + " > own.bin && cmp own.bin z80asm.bin && wc -c < own.bin");
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_GT(std::stoi("0" + ran.out), 700) << "the program with its tables";
}

TEST_F(OldHosts, TheAssemblerNamesTheLineOfAMistake) {
    struct Case {
        const char* listing;
        const char* said;
    };
    write("os8.asm", text_of(host_examples / "z80_host/os8.asm"));
    for (const Case& c :
         {Case{"* HEAD\n          NOP\n", "p.asm:2: the operation 'NOP'"},
          Case{"          LI      A,NAME\n", "p.asm:1: the symbol 'NAME' is not defined"},
          Case{"          LI      A\n", "p.asm:1: LI has 1 operands; it needs 2"},
          Case{"          LI      A,300\n", "300 is more than a byte"},
          Case{"          LI      IX,3\n", "'IX' is not a register"},
          Case{"          LDI     A,3\n", "'A' is not a pair of registers"},
          Case{"          TBT     3,A\n", "3 is not the value of one bit"},
          Case{"          DMB     200,0\n          JZS     16384\n", "p.asm:2: 16384 is -202 bytes away"},
          Case{"A         =       1\nA         =       2\n", "p.asm:2: the symbol 'A' has two values"},
          Case{"          LI      A,2+\n", "a number is missing in '2+'"},
          Case{"          DMB     50000,0\n", "the program reaches F000h"}}) {
        const Ran ran = about(MOTIONRACK_Z80_EXAMPLE " bytes", "p.asm", c.listing);
        EXPECT_EQ(ran.code, 1) << c.listing;
        EXPECT_THAT(ran.out, HasSubstr(c.said)) << c.listing;
    }
}

#else

TEST_F(OldHosts, ThePrintedZ80ProgramPrintsTheExpectedOutput) {
    GTEST_SKIP() << "libz80ex is missing, so examples/z80_host was not built: apt-get install libz80ex-dev";
}

#endif

}  // namespace
}  // namespace motionrack
