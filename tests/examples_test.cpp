// Every example produces the output and the exit code stored in its folder.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <tests/ran.hpp>
#include <tests/source_root.hpp>
#include <tests/text_of.hpp>

using motionrack::interrupted;
using motionrack::Ran;
using motionrack::run_in;
using motionrack::text_of;

namespace {

Ran run(const std::filesystem::path& folder, const std::string& command) {
    return run_in(folder, command, "/dev/null");
}

const std::filesystem::path examples = motionrack::source_root / "examples";

class Example : public testing::TestWithParam<std::string> {};

TEST_P(Example, PrintsTheExpectedOutput) {
    const std::filesystem::path folder = examples / GetParam();
    std::istringstream commands(text_of(folder / "command")), codes(text_of(folder / "exit_code"));
    std::string printed, command;
    int commands_run = 0;
    while (std::getline(commands, command)) {
        const Ran ran = run(folder, std::string(MOTIONRACK_PROGRAM) + " " + command);
        int expected = -1;
        codes >> expected;
        EXPECT_EQ(ran.code, expected) << command;
        printed += ran.out;
        ++commands_run;
    }
    EXPECT_GT(commands_run, 0);
    EXPECT_EQ(printed, text_of(folder / "expected.txt"));
}

INSTANTIATE_TEST_SUITE_P(Folders, Example,
                         testing::Values("01_first_move", "02_part", "03_helix", "04_s_curve", "05_limit_hit",
                                         "08_homing", "11_carriage", "16_probe"));

TEST(Examples, TheLibraryExampleEndsAtTheTargetOfItsProgram) {
    const Ran ran = run(examples, MOTIONRACK_LIBRARY_EXAMPLE);
    EXPECT_EQ(ran.code, 0);
    EXPECT_NE(ran.out.find("X 20.0000 mm"), std::string::npos) << ran.out;
    EXPECT_NE(ran.out.find("Y 15.0000 mm"), std::string::npos) << ran.out;
}

TEST(Examples, TheCExamplePrintsTheExpectedOutput) {
    const Ran ran = run(examples, MOTIONRACK_C_EXAMPLE);
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(examples / "07_c" / "expected.txt"));
}

TEST(Examples, TheFunctionLibraryInCPrintsTheExpectedOutput) {
    const Ran ran = run(examples, std::string("MOTIONRACK_RACK=racks/single.toml ") + MOTIONRACK_MCX314LIB_EXAMPLE);
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(examples / "09_mcx314lib" / "expected.txt"));
}

TEST(Examples, TheDataBoardsLibraryInCPrintsTheExpectedOutput) {
    const Ran ran = run(examples, MOTIONRACK_DATABOARD4002LIB_EXAMPLE);
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(examples / "databoard4002lib" / "expected.txt"));
}

TEST(Examples, TheMarkingJobInCPrintsTheExpectedOutput) {
    const Ran ran = run(examples, MOTIONRACK_RTC5SIM_EXAMPLE);
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(examples / "rtc5sim" / "expected.txt"));
}

TEST(Examples, TheMarkingLineInCPrintsTheExpectedOutput) {
    const Ran ran = run(examples / "14_line", MOTIONRACK_LINE_EXAMPLE " line.toml");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(examples / "14_line" / "expected.txt"));
}

TEST(Examples, TheOldHostProgramPrintsTheExpectedOutput) {
    const Ran ran = run(examples, MOTIONRACK_DATABOARD_C_EXAMPLE);
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(examples / "10_databoard_c" / "expected.txt"));
}

TEST(Examples, TheCarriageInCppGivesTheOutputAndPicturesOfItsPage) {
    const auto picture = std::filesystem::temp_directory_path() / "motionrack_carriage_test.svg";
    const Ran ran =
        run(examples / "11_carriage", MOTIONRACK_CARRIAGE_EXAMPLE " machine.toml '" + picture.string() + "'");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(examples / "11_carriage" / "expected_cpp.txt"));
    EXPECT_EQ(text_of(picture), text_of(examples / "11_carriage" / "carriage.svg"))
        << "make it anew: example_carriage machine.toml carriage.svg";
    std::filesystem::remove(picture);
}

TEST(Examples, TheStageGivesTheOutputAndPicturesOfItsPage) {
    const auto picture = std::filesystem::temp_directory_path() / "motionrack_stage_test.svg";
    const Ran ran = run(examples / "13_stage", MOTIONRACK_STAGE_EXAMPLE " machine.toml '" + picture.string() + "'");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.out, text_of(examples / "13_stage" / "expected.txt"));
    EXPECT_EQ(text_of(picture), text_of(examples / "13_stage" / "stage.svg"))
        << "make it anew: example_stage machine.toml stage.svg";
    std::filesystem::remove(picture);
}

TEST(Examples, TheBuiltInExampleIsThePart) {
    const Ran built_in = run(examples, std::string(MOTIONRACK_PROGRAM) + " run --no-report");
    EXPECT_EQ(built_in.code, 0);
    EXPECT_EQ(built_in.out, text_of(examples / "02_part" / "expected.txt"));
}

TEST(CommandLine, EveryCommandHasHelpWithAnExample) {
    for (const char* command : {"run",
                                "home",
                                "check",
                                "new",
                                "describe",
                                "trace",
                                "canon",
                                "plan",
                                "sweep",
                                "sweep-worker",
                                "docs",
                                "bench",
                                "completion",
                                "manual",
                                "registers",
                                "mark",
                                "calibrate scale",
                                "calibrate rotary",
                                "calibrate lag",
                                "image",
                                "image make",
                                "image show",
                                "image check"}) {
        const Ran help = run(examples, std::string(MOTIONRACK_PROGRAM) + " " + command + " --help");
        EXPECT_EQ(help.code, 0) << command;
        EXPECT_NE(help.out.find("Example: "), std::string::npos) << command;
    }
}

TEST(CommandLine, ExitCodesNameTheKindOfError) {
    const std::string program = MOTIONRACK_PROGRAM;
    EXPECT_EQ(run(examples, program + " dance").code, 1);
    EXPECT_EQ(run(examples, "printf 'G1 X5\\n' | " + program + " run - --no-report").code, 2);
    EXPECT_EQ(run(examples, program + " run no_such_file.ngc").code, 5);
    EXPECT_EQ(run(examples, program + " describe mcx315").code, 1);
    const Ran former = run(examples, program + " serve --free --speed=2 2>&1");
    EXPECT_EQ(former.code, 1);
    EXPECT_NE(former.out.find("'--free' is now '--unthrottled'."), std::string::npos) << former.out;
    EXPECT_NE(former.out.find("'--speed' is now '--time-scale'."), std::string::npos) << former.out;
    EXPECT_EQ(former.out.find("not expected"), std::string::npos) << former.out;
    EXPECT_NE(run(examples, program + " home X --type 3 2>&1").out.find("'--type' is now '--method'."),
              std::string::npos);
    EXPECT_TRUE(nlohmann::json::accept(run(examples, program + " describe mcx314 --json").out));
    EXPECT_TRUE(nlohmann::json::accept(run(examples, program + " run --json --no-report").out));
}

/// Returns the output of a run with these options, including errors and warnings.
Ran run_with(const std::string& options) {
    return run(examples, std::string(MOTIONRACK_PROGRAM) + " run 01_first_move/first_move.ngc --no-report -q " +
                             options + " 2>&1");
}

TEST(CommandLine, FaultsAreInjectedAtTheirInstantAndEventsAreWritten) {
    const auto events = std::filesystem::temp_directory_path() / "motionrack_events_test.csv";
    const Ran stopped = run_with("--fault X.limit_plus=0@0.25s --events '" + events.string() + "'");
    EXPECT_EQ(stopped.code, 4);
    EXPECT_NE(stopped.out.find("the + limit switch was reached"), std::string::npos) << stopped.out;
    const std::string written = text_of(events);
    EXPECT_EQ(written.rfind("time_s,event,line,x_mm,y_mm,z_mm,text\r\n", 0), 0u) << written;
    EXPECT_NE(written.find(",stop,3,"), std::string::npos) << written;
    std::filesystem::remove(events);

    const Ran lost = run_with("--fault X.motor.lose_steps=64@100ms --fault X.home=release@99s");
    EXPECT_EQ(lost.code, 4);
    EXPECT_NE(lost.out.find("lost 64 pulses"), std::string::npos) << lost.out;
    EXPECT_NE(lost.out.find("at 0.100000 s"), std::string::npos) << lost.out;
    EXPECT_NE(lost.out.find("ended before the fault X.home=release@99s"), std::string::npos) << lost.out;
}

/// The headline of a report: green, or red with exit code 4.
TEST(CommandLine, AFailedRunEndsWithCode4AndARedHeading) {
    const auto page = std::filesystem::temp_directory_path() / "motionrack_headline_test.html";
    const auto run_to_page = [&](const std::string& options) {
        std::filesystem::remove(page);
        return run(examples, std::string(MOTIONRACK_PROGRAM) +
                                 " run 01_first_move/first_move.ngc -q --json --report '" + page.string() + "' " +
                                 options);
    };
    const std::string good = "<p class=\"verdict good\">", wrong = "<p class=\"verdict wrong\">";
    const Ran kept = run_to_page("");
    EXPECT_EQ(kept.code, 0);
    EXPECT_EQ(nlohmann::json::parse(kept.out)["ok"], true);
    EXPECT_NE(text_of(page).find(good), std::string::npos);
    for (const char* fault : {"X.motor.lose_steps=64@100ms", "X.limit_plus=0@0.25s"}) {
        const Ran ran = run_to_page(std::string("--fault ") + fault);
        EXPECT_EQ(ran.code, 4) << fault;
        EXPECT_EQ(nlohmann::json::parse(ran.out)["ok"], false) << fault;
        EXPECT_NE(text_of(page).find(wrong), std::string::npos) << fault;
        EXPECT_EQ(text_of(page).find(good), std::string::npos) << fault;
    }
    std::filesystem::remove(page);
}

TEST(CommandLine, AStopExecutesNoFurtherLine) {
    const auto folder = std::filesystem::temp_directory_path() / "motionrack_stop_test";
    std::filesystem::create_directories(folder);
    const Ran stopped = run(folder, "printf 'G21 G90 F600\nG1 X100\nG1 Y50\nM2\n' | " MOTIONRACK_PROGRAM
                                    " run - --no-report --json --at stop@1s");
    EXPECT_EQ(stopped.code, 130);
    const nlohmann::json json = nlohmann::json::parse(stopped.out);
    EXPECT_EQ(json["ok"], false);
    EXPECT_EQ(json["error"]["line"], 2);
    EXPECT_LT(json["duration_s"].get<double>(), 1.2);
    for (const nlohmann::json& axis : json["axes"]) {
        const auto pulses = axis["pulses_sent"].get<std::int64_t>();
        EXPECT_EQ(pulses > 0, axis["axis"] == "X") << "Y is that of line 3: " << axis;
    }
    std::filesystem::remove_all(folder);
}

TEST(CommandLine, ImpossibleFaultsAreRejectedBeforeAnythingMoves) {
    struct Case {
        const char* option;
        const char* said;
    };
    for (const Case& c :
         {Case{"X.limit_plus=0", "needs its time"}, Case{"X.limit_plus=0@1", "needs its time"}, Case{"@1s", "neither"},
          Case{"X.limit_plus=0@-1s", "needs its time"}, Case{"X.limit_plus=nan@1e99s", "needs its time"},
          Case{"X.limit_plus=high@1s", "0, 1 or release"}, Case{"X.limit_plus=2@1s", "0 or 1"},
          Case{"X.limitplus=0@1s", "did you mean 'X.limit_plus'?"}, Case{"Q.motor.stall@1s", "X, Y, Z, A"},
          Case{"X.motor.stal@1s", "motor.stall"}, Case{"motion.xpp=1@1s", "output"},
          Case{"A.limit_plus.stuck_open@1s", "Axis A"}}) {
        const Ran refused = run_with(std::string("--fault '") + c.option + "'");
        EXPECT_TRUE(refused.code == 2 || refused.code == 3) << c.option << ": " << refused.code;
        EXPECT_NE(refused.out.find(c.said), std::string::npos) << refused.out;
        EXPECT_EQ(refused.out.find("pulses  "), std::string::npos) << "no summary";
    }
}

TEST(CommandLine, InterruptedItStopsAlongThePathAndKeepsTheReport) {
    const auto folder = std::filesystem::temp_directory_path() / "motionrack_interrupt_test";
    std::filesystem::create_directories(folder);
    std::filesystem::remove(folder / "report.html");
    // A program that takes hours of virtual time.
    const Ran ran = run(folder, "yes 'G1 X100 F60\nG1 X0' | head -n 2000000 > long.ngc; " +
                                    interrupted(MOTIONRACK_PROGRAM " run long.ngc --stream", "1") +
                                    "; code=$?; rm -f long.ngc; exit $code");
    EXPECT_EQ(ran.code, 130);
    EXPECT_NE(ran.out.find("Stopped on request in line"), std::string::npos) << ran.out;
    EXPECT_TRUE(std::filesystem::exists(folder / "report.html"));
    std::filesystem::remove_all(folder);
}

}  // namespace
