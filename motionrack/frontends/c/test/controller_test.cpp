// Part programs and homings over the C interface.
#include <gmock/gmock.h>

#include <cmath>
#include <motionrack/frontends/c/test/world.hpp>
#include <string>
#include <vector>

namespace motionrack::c_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr const char* square = "G21 G90\nG1 X15 F1200\nG1 Y10\nG1 X5\nG1 Y0\nM2\n";

struct Progress {
    mr_rack* rack = nullptr;
    double stop_at_s = 1e9;
    std::vector<double> seconds;
    std::vector<std::int64_t> lines, of;
    std::vector<int> codes;
    static int call(void* user, double seconds, std::int64_t line, std::int64_t lines) {
        auto& own = *static_cast<Progress*>(user);
        own.seconds.push_back(seconds);
        own.lines.push_back(line);
        own.of.push_back(lines);
        if (own.rack != nullptr) {
            own.codes.push_back(mr_advance_ns(own.rack, 1));
            own.codes.push_back(mr_run_program(own.rack, square, nullptr, nullptr));
        }
        return seconds >= own.stop_at_s;
    }
    mr_run_options options() { return {nullptr, 0, &Progress::call, this}; }
};

TEST(CProgram, IsExecutedToItsEndAndReportsItsResult) {
    World world(homing_rack);
    Progress progress;
    const mr_run_options options = progress.options();
    const mr_run_result result = run(world, square, MR_OK, &options);
    EXPECT_EQ(result.ok, 1);
    EXPECT_EQ(result.line, 0);
    EXPECT_NEAR(result.path_mm, 40, 1e-9);
    EXPECT_GT(result.seconds, 2);
    EXPECT_LT(result.deviation_mm, 0.02);
    EXPECT_THAT(result.sentence, HasSubstr("The program ended"));
    EXPECT_THAT(mr_report(world), HasSubstr("path        40.000 mm"));
    EXPECT_EQ(world.part("X.position_mm"), 5);
    EXPECT_NEAR(static_cast<double>(mr_now_ns(world)) * 1e-9, result.seconds, 1e-3);
    ASSERT_GT(progress.seconds.size(), 30u);
    EXPECT_EQ(progress.of.front(), 7);
    for (std::size_t i = 1; i < progress.seconds.size(); ++i) {
        EXPECT_GE(progress.seconds[i], progress.seconds[i - 1]);
        EXPECT_LE(progress.seconds[i], progress.seconds[i - 1] + 0.0501);
        EXPECT_GE(progress.lines[i], progress.lines[i - 1]);
    }
    EXPECT_EQ(progress.lines.back(), 5);
}

TEST(CProgram, GivesTheSameEventTraceWithAndWithoutCallbacksAndFromAFile) {
    const std::string file = temporary("square.ngc");
    std::ofstream(file) << square;
    World plain(homing_rack), watched(homing_rack), from_file(homing_rack);
    run(plain, square, MR_OK);
    Progress progress;
    const mr_run_options options = progress.options();
    EXPECT_EQ(mr_on_condition(
                  watched, [](void*, std::uint64_t, std::int64_t, const char*, int, const char*) {}, nullptr),
              MR_OK);
    run(watched, square, MR_OK, &options);
    run(from_file, file, MR_OK);
    EXPECT_EQ(watched.hash(), plain.hash());
    EXPECT_EQ(from_file.hash(), plain.hash());
    std::filesystem::remove(file);
}

TEST(CProgram, EveryErrorIsReportedWithLineAndColumnBeforeAnythingMoves) {
    World world(homing_rack);
    const std::uint64_t before = world.hash();
    const mr_run_result result = run(world, "G21 G90\nG1 X7 F600\nG1 Xq\nG1 X3000\n", MR_BAD_INPUT);
    EXPECT_EQ(result.ok, 0);
    EXPECT_EQ(result.line, 3);
    EXPECT_GE(result.column, 4);
    EXPECT_EQ(result.seconds, 0);
    EXPECT_THAT(result.sentence, HasSubstr("program:3:"));
    EXPECT_THAT(result.sentence, HasSubstr("\nprogram:4:4: X3000"));
    EXPECT_THAT(result.sentence, EndsWith("program has 2 problems; nothing was moved."));
    EXPECT_STREQ(mr_last_error(), result.sentence);
    EXPECT_STREQ(mr_report(world), "");
    EXPECT_EQ(world.hash(), before);
    EXPECT_EQ(mr_now_ns(world), 0u);
    EXPECT_EQ(run(world, square, MR_OK).ok, 1) << "a good program runs after a bad one";
}

TEST(CProgram, FilesThatCannotBeReadAreRefused) {
    World world(homing_rack);
    EXPECT_EQ(run(world, "/no/such.ngc", MR_IO).ok, 0);
    EXPECT_THAT(mr_last_error(), HasSubstr("/no/such.ngc"));
    const mr_run_options tools{"/no/such.tbl", 0, nullptr, nullptr};
    run(world, square, MR_IO, &tools);
    EXPECT_THAT(mr_last_error(), HasSubstr("/no/such.tbl"));
    EXPECT_EQ(mr_now_ns(world), 0u);
}

TEST(CProgram, SubprogramsLieBesideItsFileAndToolsInATable) {
    const std::filesystem::path folder = temporary("programs");
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "main.ngc") << "G21 G90 G43 H1\no<side> call [15]\n/G1 X100\nM2\n";
    std::ofstream(folder / "side.ngc") << "o<side> sub\nG1 X#1 F1200\no<side> endsub\nM2\n";
    std::ofstream(folder / "tools.tbl") << "T1 P1 X0 Z5 D3 ;\n";
    World world(homing_rack);
    const std::string tools = (folder / "tools.tbl").string();
    const mr_run_options options{tools.c_str(), 1, nullptr, nullptr};
    run(world, (folder / "main.ngc").string(), MR_OK, &options);
    EXPECT_EQ(world.part("X.position_mm"), 15) << "the line with / was left out";
    std::filesystem::remove_all(folder);
}

TEST(CProgram, AReturnValueOfTheProgressCallbackStopsItOnThePath) {
    World world(homing_rack);
    Progress progress;
    progress.stop_at_s = 0.3;
    const mr_run_options options = progress.options();
    const mr_run_result result = run(world, square, MR_STOPPED, &options);
    EXPECT_EQ(result.ok, 0);
    EXPECT_EQ(result.line, 2);
    EXPECT_THAT(result.sentence, HasSubstr("program:2:1: Stopped on request"));
    EXPECT_GT(world.part("X.position_mm"), 6);
    EXPECT_LT(world.part("X.position_mm"), 15);
    const double stopped_at = world.part("X.position_mm");
    world.pass(1'000'000'000);
    EXPECT_EQ(world.part("X.position_mm"), stopped_at);
}

TEST(CProgram, StoppedByTheMachineOrWithALostPositionIsNotOk) {
    World stalled(homing_rack);
    EXPECT_EQ(mr_fault(stalled, "motor.stall", "X"), MR_OK);
    const mr_run_result stopped = run(stalled, square, MR_MACHINE);
    EXPECT_EQ(stopped.ok, 0);
    EXPECT_EQ(stopped.line, 2);
    EXPECT_THAT(stopped.sentence, HasSubstr("following error of X"));

    World pushed(homing_rack);
    struct Pusher {
        mr_rack* rack;
        int code = -1;
        static int call(void* user, double seconds, std::int64_t, std::int64_t) {
            auto& own = *static_cast<Pusher*>(user);
            if (seconds > 0.3 && own.code != MR_OK) own.code = mr_fault(own.rack, "motor.lose_steps=64", "X");
            return 0;
        }
    } pusher{pushed.rack};
    const mr_run_options options{nullptr, 0, &Pusher::call, &pusher};
    const mr_run_result lost = run(pushed, square, MR_MACHINE, &options);
    EXPECT_EQ(lost.ok, 0);
    EXPECT_THAT(lost.sentence, HasSubstr("lost 64 pulses"));
    EXPECT_STREQ(mr_last_error(), lost.sentence);
}

TEST(CProgram, NeedsARackWithAxes) {
    World board("card.c1 = \"databoard4002\"");
    run(board, square, MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("no axes"));
}

TEST(CProgram, CannotBeCalledFromItsProgressCallback) {
    World world(homing_rack);
    Progress progress;
    progress.rack = world.rack;
    const mr_run_options options = progress.options();
    run(world, square, MR_OK, &options);
    for (const int code : progress.codes) EXPECT_EQ(code, MR_REFUSED);
    EXPECT_EQ(world.part("X.position_mm"), 5);
}

TEST(CProgram, RecordsItsMotion) {
    World world(homing_rack);
    const std::string csv = temporary("program.csv");
    ASSERT_EQ(mr_trace_start(world, csv.c_str(), "X.step X.dir c1.xlp"), MR_OK) << mr_last_error();
    run(world, square, MR_OK);
    ASSERT_EQ(mr_trace_stop(world), MR_OK) << mr_last_error();
    EXPECT_EQ(count_of(text_of_file(csv), ",X.step,1\r\n"), 20 * 640);
    EXPECT_GT(count_of(text_of_file(csv), ",c1.xlp,"), 20) << "looked at every 50 ms";
    std::filesystem::remove(csv);
}

TEST(CProgram, NullPointersAreBadCalls) {
    World world(homing_rack);
    mr_run_result result{};
    EXPECT_EQ(mr_run_program(nullptr, square, nullptr, &result), MR_BAD_CALL);
    EXPECT_EQ(mr_run_program(world, nullptr, nullptr, &result), MR_BAD_CALL);
    EXPECT_STREQ(result.sentence, "") << "it can be printed whatever happened";
    EXPECT_EQ(mr_home(nullptr, "X"), MR_BAD_CALL);
    EXPECT_STREQ(mr_report(nullptr), "");
    EXPECT_EQ(mr_run_program(world, square, nullptr, nullptr), MR_OK);
}

// ---- homing

TEST(CHome, FindsTheSwitchesAndReportsTheResultsOfTheCommandLine) {
    World world(homing_rack);
    ASSERT_EQ(mr_home(world, nullptr), MR_OK) << mr_last_error();
    EXPECT_THAT(mr_report(world), HasSubstr("axis X  method 2"));
    EXPECT_THAT(mr_report(world), HasSubstr("the position is valid"));
    EXPECT_THAT(mr_report(world), HasSubstr("all homed in"));
    EXPECT_NEAR(world.part("X.position_mm"), 1, 0.01);
    EXPECT_GT(mr_now_ns(world), 100'000'000u);
    EXPECT_EQ(mr_home(world, "x"), MR_OK) << "and again";
    EXPECT_EQ(mr_home(world, " X, "), MR_OK);
}

TEST(CHome, AxesThatCannotBeHomedAreRefusedBeforeAnythingMoves) {
    World world(homing_rack);
    EXPECT_EQ(mr_home(world, "Y"), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("no home switch"));
    EXPECT_EQ(mr_home(world, "XQ"), MR_REFUSED);
    EXPECT_THAT(mr_last_error(), HasSubstr("no axis 'Q'"));
    EXPECT_EQ(mr_now_ns(world), 0u);
    EXPECT_EQ(world.part("X.position_mm"), 5);
    World board("card.c1 = \"databoard4002\"");
    EXPECT_EQ(mr_home(board, nullptr), MR_REFUSED);
}

TEST(CHome, ASwitchThatIsNotFoundIsReported) {
    World world(homing_rack);
    EXPECT_EQ(mr_fault(world, "home.stuck_open", "X"), MR_OK);
    EXPECT_EQ(mr_home(world, "X"), MR_MACHINE);
    EXPECT_GT(std::string(mr_last_error()).size(), 30u);
    EXPECT_THAT(mr_report(world), HasSubstr("not homed"));
}

TEST(CHome, GivesTheSameResultsWithAConditionCallback) {
    World plain(homing_rack), watched(homing_rack);
    EXPECT_EQ(mr_on_condition(
                  watched, [](void*, std::uint64_t, std::int64_t, const char*, int, const char*) {}, nullptr),
              MR_OK);
    EXPECT_EQ(mr_home(plain, nullptr), MR_OK);
    EXPECT_EQ(mr_home(watched, nullptr), MR_OK);
    EXPECT_EQ(plain.hash(), watched.hash());
}

}  // namespace
}  // namespace motionrack::c_test
