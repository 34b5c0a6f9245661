// Chips, errors, time, homing, manual operation, contours and bit patterns over the C library; exported names.
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <motionrack/frontends/mcx314lib/test/chip.hpp>
#include <tests/source_root.hpp>
#include <thread>

namespace motionrack::mcx314lib_test {
namespace {

using testing::HasSubstr;

constexpr const char* two_cards = "card.left = \"mcx314\"\ncard.right = \"mcx314\"";
constexpr const char* with_home = R"(
[card.c1]
type = "mcx314"
[axis.X]
card = "c1"
channel = "x"
initial_position_mm = 20
encoder_counts_per_rev = 3200
[axis.X.switches]
limit_minus_mm = -2
limit_plus_mm = 302
home_mm = 1
)";
constexpr int home_input = 0x0002;  // IN0 enabled, active low

// ---- chips

TEST(Mcx314libChips, WithoutARackTheFirstFunctionNamesTheVariableToSet) {
    ::unsetenv("MOTIONRACK_RACK");
    mcx314_clear_error();
    SetRange(800'000);
    EXPECT_THAT(mcx314_last_error(),
                HasSubstr("SetRange: No chip is open, and the environment variable MOTIONRACK_RACK is not set"));
    EXPECT_EQ(mcx314_now_us(), -1);
    EXPECT_EQ(mcx314_open(nullptr, nullptr), -1);
    ::setenv("MOTIONRACK_RACK", "/no/such/rack.toml", 1);
    SetRange(800'000);
    EXPECT_THAT(mcx314_last_error(), HasSubstr("/no/such/rack.toml"));
    ::unsetenv("MOTIONRACK_RACK");
}

TEST(Mcx314libChips, TheFirstFunctionOpensTheRackOfTheEnvironment) {
    ::setenv("MOTIONRACK_RACK", (source_dir() + "/examples/racks/single.toml").c_str(), 1);
    mcx314_clear_error();
    SetRange(400'000);
    EXPECT_STREQ(mcx314_last_error(), "");
    EXPECT_EQ(peek("x.R"), 400'000);
    ::unsetenv("MOTIONRACK_RACK");
    EXPECT_EQ(mcx314_close(mcx314_open(nullptr, nullptr)), -1) << "its only card is open";
    EXPECT_THAT(mcx314_last_error(), HasSubstr("Unknown chip handle -1; the handles of the open chips are: "));
    const std::string reported = mcx314_last_error();
    EXPECT_EQ(mcx314_close(std::stoi(reported.substr(reported.find("are: ") + 5))), 0);
}

TEST(Mcx314libChips, TwoChipsOfARackShareItsClock) {
    const Open left(two_cards), right(nullptr);
    EXPECT_EQ(mcx314_open(nullptr, nullptr), -1);
    EXPECT_THAT(mcx314_last_error(), HasSubstr("left (open already), right (open already)"));
    set_up();
    TCurve_F(x, 100, 4000, 400, 5000);
    EXPECT_EQ(mcx314_select(left.handle), 0);
    set_up();
    TCurve_F(x, 100, 2000, 400, -3000);
    EXPECT_EQ(mcx314_wait(x, 10'000), 0);
    EXPECT_EQ(static_cast<int>(ReadLPS(x)), -3000);
    const std::int64_t now = mcx314_now_us();
    EXPECT_EQ(mcx314_select(right.handle), 0);
    EXPECT_EQ(mcx314_now_us(), now);
    EXPECT_EQ(mcx314_wait(x, 10'000), 0);
    EXPECT_EQ(static_cast<int>(ReadLPS(x)), 5000);
}

/// A file in the place of a real card: a word has what was written last.
class FileAsCard {
  public:
    ~FileAsCard() { std::filesystem::remove(path_); }
    void fill(char byte) const { std::ofstream(path_, std::ios::binary) << std::string(16, byte); }
    std::string place() const { return "port:" + path_.string(); }

  private:
    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("motionrack_mcx314lib_card_" + std::to_string(::getpid()));
};

TEST(Mcx314libChips, ARealCardThatDoesNotAnswerIsNotOpened) {
    const FileAsCard file;
    file.fill('\xFF');
    mcx314_clear_error();
    EXPECT_EQ(mcx314_open(file.place().c_str(), nullptr), -1);
    EXPECT_THAT(mcx314_last_error(), HasSubstr("Every register reads FFFFh: no card answers at "));
}

TEST(Mcx314libChips, ARealCardThatStopsAnsweringIsAnErrorOfEachCall) {
    const FileAsCard file;
    file.fill('\0');
    const int handle = mcx314_open(file.place().c_str(), nullptr);
    ASSERT_GT(handle, 0) << mcx314_last_error();
    mcx314_clear_error();
    SetRange(800'000);
    EXPECT_STREQ(mcx314_last_error(), "");
    file.fill('\xFF');
    EXPECT_EQ(mcx314_moving(x), -1);
    const std::string gone = mcx314_last_error();
    EXPECT_THAT(gone, HasSubstr("no card answers at "));
    EXPECT_THAT(gone, HasSubstr("their positions are not valid"));
    mcx314_clear_error();
    EXPECT_EQ(ReadLPS(x), 0u) << "not the -1 of an empty slot";
    EXPECT_THAT(mcx314_last_error(), HasSubstr("ReadLPS: Every register reads FFFFh"));
    EXPECT_EQ(mcx314_wait(x, 1000), -1);
    EXPECT_THAT(mcx314_last_error(), HasSubstr("mcx314_wait: Every register reads FFFFh"));
    EXPECT_EQ(mcx314_close(handle), 0);
}

TEST(Mcx314libChips, ChipsOfTwoRacksHaveTheirOwnClocks) {
    const Open one, other(two_cards, "right");
    set_up();
    EXPECT_EQ(mcx314_advance_ms(5000), 0);
    EXPECT_EQ(mcx314_select(one.handle), 0);
    EXPECT_LT(mcx314_now_us(), 1000);
    EXPECT_EQ(peek("x.R"), 0);
    EXPECT_EQ(mcx314_select(99'999), -1);
    EXPECT_LT(mcx314_now_us(), 1000) << "the selection stays";
    EXPECT_EQ(mcx314_open(two_cards, "middle"), -1);
    EXPECT_THAT(mcx314_last_error(), HasSubstr("left, right"));
}

TEST(Mcx314libChips, SelectsNoOtherChipWhenTheSelectedOneIsClosed) {
    const Open one;
    EXPECT_EQ(mcx314_close(mcx314_open(two_cards, nullptr)), 0);
    mcx314_clear_error();
    SetRange(800'000);
    EXPECT_THAT(mcx314_last_error(), HasSubstr("No chip is selected"));
    EXPECT_EQ(mcx314_select(one.handle), 0);
    EXPECT_EQ(peek("x.R"), 0);
}

// ---- plans

TEST(Mcx314libPlans, DescribeADriveThatThenEndsAtItsStartSpeed) {
    const Open chip;
    set_up();
    for (const int k : {0, 1010}) {
        const int way = 50'000;
        MCX314_PLAN plan = {};
        ASSERT_EQ(mcx314_plan(x, 100, 4000, 400, k, way, &plan), 0) << mcx314_last_error();
        EXPECT_EQ(plan.top_hz, 40'000);
        EXPECT_EQ(plan.end_hz, 1'000);
        EXPECT_EQ(mcx314_moving(all), 0);
        const std::int64_t begun = mcx314_now_us();
        const int from = static_cast<int>(ReadLPS(x));
        if (k == 0)
            TCurve_F(x, 100, 4000, 400, way);
        else
            SCurve_F(x, 100, 4000, 400, k, way);
        EXPECT_EQ(peek("x.AO"), plan.offset);
        std::int64_t last_speed = 0;
        while (mcx314_moving(x) != 0) {
            if (const unsigned speed = ReadCV(x); speed != 0) last_speed = speed;
        }
        EXPECT_LE(last_speed, 101) << "K " << k;
        EXPECT_NEAR(static_cast<double>(mcx314_now_us() - begun) * 1e-6, plan.seconds, 1e-4);
        EXPECT_EQ(static_cast<int>(ReadLPS(x)) - from, way);
    }
    SetAO(x, 3);
    SCurve_F(x, 100, 4000, 400, 1010, 20'000);
    EXPECT_EQ(peek("x.AO"), 3) << "the user's own stays";
    EXPECT_EQ(mcx314_wait(x, 10'000), 0);
    MCX314_PLAN own = {};
    EXPECT_EQ(mcx314_plan(x, 100, 4000, 400, 1010, 20'000, &own), 0);
    EXPECT_EQ(own.offset, 3);
    ManualDec(x, 1'500);
    EXPECT_EQ(mcx314_plan(x, 100, 4000, 400, 0, 2'000, &own), 0);
    EXPECT_EQ(own.dec_point, 1'500);
}

// ---- errors, time

TEST(Mcx314libErrors, TheHandlerMayCallTheLibrary) {
    const Open chip;
    set_up();
    TCurve_C(x, 100, 4000, 400);
    int stopped = 0;
    mcx314_on_error([](const char*, void* user) { *static_cast<int*>(user) += mcx314_stop_now(all) == 0 ? 1 : 100; },
                    &stopped);
    SetV(x, 9000);
    mcx314_on_error(nullptr, nullptr);
    EXPECT_EQ(stopped, 1);
    EXPECT_EQ(mcx314_moving(all), 0);
}

TEST(Mcx314libErrors, EachThreadHasItsOwnMessage) {
    const Open chip;
    SetV(x, 9000);
    const std::string here = mcx314_last_error();
    std::string there = "?";
    std::thread([&there] {
        there = mcx314_last_error();
        SetA(x, 0);
    }).join();
    EXPECT_EQ(there, "");
    EXPECT_EQ(mcx314_last_error(), here);
}

TEST(Mcx314libTime, APollingLoopEnds) {
    const Open chip;
    set_up();
    TCurve_F(x, 100, 4000, 400, 2000);
    int looks = 0;
    while (ReadCV(x) != 0 && looks < 10'000'000) ++looks;
    EXPECT_EQ(static_cast<int>(ReadLPS(x)), 2000);
    EXPECT_GT(looks, 10);
}

TEST(Mcx314libTime, TheRackRunsForTheMaximumIntOfMilliseconds) {
    const Open chip;
    EXPECT_EQ(mcx314_advance_ms(2'147'483'647), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_now_us(), 2'147'483'647'000);
}

TEST(Mcx314libTime, AWaitThatTimesOutReportsIt) {
    const Open chip;
    set_up();
    TCurve_C(x, 100, 4000, 400);
    EXPECT_EQ(mcx314_wait(x, 50), -1);
    EXPECT_NEAR(static_cast<double>(mcx314_now_us()), 50'000, 1000);
    EXPECT_EQ(mcx314_stop(x), 0);
    EXPECT_EQ(mcx314_wait(x, 1000), 0) << mcx314_last_error();
}

TEST(Mcx314libStatus, ALimitSwitchStopsAndIsReported) {
    const Open chip;
    set_up();
    TCurve_C(x, 100, 4000, 400);
    mcx314_advance_ms(100);
    EXPECT_EQ(mcx314_moving(all), x);
    EXPECT_EQ(mcx314_at_limit(all), 0);
    EXPECT_EQ(mcx314_set_wire("c1.xlmtp", 0), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_wait(x, 1000), -1);
    EXPECT_THAT(mcx314_last_error(), HasSubstr("the + limit switch was reached"));
    EXPECT_EQ(mcx314_at_limit(all), x);
    EXPECT_THAT(mcx314_report(x + y), HasSubstr("the + limit switch was reached"));
    EXPECT_EQ(mcx314_set_wire("c1.xlmtp", std::nan("")), 0);
    EXPECT_STREQ(mcx314_report(0), "");
}

TEST(Mcx314libStatus, TheEndOfADriveInterrupts) {
    const Open chip;
    set_up();
    EXPECT_EQ(mcx314_enable_interrupt(x, MCX314_DRIVE_END), 0);
    TCurve_F(x, 100, 4000, 400, 100);
    mcx314_advance_ms(1000);
    EXPECT_EQ(mcx314_read_interrupt(x), MCX314_DRIVE_END);
    EXPECT_EQ(mcx314_read_interrupt(x), 0);
}

// ---- home, manual operation

TEST(Mcx314libHome, EveryTypeEndsAtHome) {
    using Home = void (*)(int, int, int, int);
    for (const Home home : {HomeType1, HomeType2, HomeType3, HomeType4}) {
        const Open chip(with_home);
        SetRange(800'000);
        EXPECT_EQ(mcx314_home_axes(x), 0);
        home(home_input | 0x10, 50, 600, 100);  // IN2, the index, active high
        EXPECT_STREQ(mcx314_last_error(), "");
        EXPECT_EQ(mcx314_moving(all), 0);
        EXPECT_EQ(ReadLPS(x), 0u);
        EXPECT_GT(mcx314_now_us(), 1'000'000);
    }
}

TEST(Mcx314libHome, AnAxisWithoutASwitchReportsThatNoneWasFound) {
    const Open chip(with_home);
    SetRange(800'000);
    EXPECT_EQ(mcx314_set_wire("X.home", 1), 0) << mcx314_last_error();
    HomeType1(home_input, 50, 2000, 100);
    EXPECT_THAT(mcx314_last_error(), HasSubstr("HomeType1: "));
    EXPECT_EQ(mcx314_moving(all), 0);
}

TEST(Mcx314libManual, AJogEndsWithoutRenewal) {
    const Open chip;
    SetRange(800'000);
    for (int i = 0; i < 5; ++i) {
        EXPECT_EQ(mcx314_jog(x, 50, 1000, 100), 0) << mcx314_last_error();
        mcx314_advance_ms(200);
        EXPECT_EQ(mcx314_moving(x), x);
    }
    EXPECT_EQ(mcx314_wait(x, 5000), 0) << mcx314_last_error();
    const int there = static_cast<int>(ReadLPS(x));
    EXPECT_GT(there, 10'000);
    EXPECT_EQ(mcx314_jog_step(x, 50, 1000, 100, -1000), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_wait(x, 5000), 0);
    EXPECT_EQ(static_cast<int>(ReadLPS(x)), there - 1000);
    EXPECT_EQ(mcx314_jog(x, 50, -1000, 100), 0);
    EXPECT_EQ(mcx314_stop_now(x), 0);
    EXPECT_EQ(mcx314_wait(x, 0), 0) << mcx314_last_error();
}

TEST(Mcx314libManual, AHomingContinuesWhileItIsRenewed) {
    const Open chip(with_home);
    SetRange(800'000);
    for (int i = 0; i < 200; ++i) {
        EXPECT_EQ(mcx314_jog_home(x, 2, home_input, 50, 600, 100), 0) << mcx314_last_error();
        mcx314_advance_ms(100);
        if (ReadLPS(x) == 0 && mcx314_moving(x) == 0) break;
    }
    EXPECT_EQ(ReadLPS(x), 0u);
    EXPECT_GT(mcx314_now_us(), 1'000'000);
}

// ---- contours, patterns

TEST(Mcx314libContour, LinesAndArcsEndAtTheirFinishPoints) {
    const Open chip;
    SetRange(800'000);
    const MCX314_CONTOUR speeds = {100, 1000, 200, 0};
    const int along[4] = {2000, 0, 0, 0}, round[4] = {500, 500, 0, 0}, centre[4] = {0, 500, 0, 0};
    EXPECT_EQ(mcx314_contour_begin(&speeds), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_contour_line(x + y, along, 0), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_contour_arc(x + y, round, centre, 0, 0), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_contour_end(), 0) << mcx314_last_error();
    EXPECT_EQ(static_cast<int>(ReadLPS(x)), 2500);
    EXPECT_EQ(static_cast<int>(ReadLPS(y)), 500);
}

TEST(Mcx314libPattern, ThePulsesAreThoseOfTheBits) {
    const Open chip;
    SetRange(800'000);
    const MCX314_PATTERN speeds = {0, 100, 0, 0};
    const MCX314_STEPS first = {{0xFFFF, 0x00FF, 0}, {0, 0, 0}}, last = {{0x8000, 0, 0}, {0x800F, 0x0003, 0}};
    EXPECT_EQ(mcx314_pattern_begin(&speeds, x + y), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_pattern_steps(&first), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_pattern_steps(&last), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_pattern_start(), 0) << mcx314_last_error();
    EXPECT_EQ(mcx314_pattern_end(), 0) << mcx314_last_error();
    EXPECT_EQ(static_cast<int>(ReadLPS(x)), 12);
    EXPECT_EQ(static_cast<int>(ReadLPS(y)), 6);
}

// ---- the library's names

TEST(Mcx314lib, ExportsTheFunctionsOfItsHeaderOnly) {
    const std::set<std::string> declared = declared_functions();
    std::FILE* pipe = ::popen("nm -D --defined-only --format=just-symbols '" MCX314LIB_LIBRARY "'", "r");
    ASSERT_NE(pipe, nullptr);
    std::set<std::string> shown;
    std::array<char, 512> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
        std::string name = line.data();
        shown.insert(name.substr(0, name.find_last_not_of('\n') + 1));
    }
    EXPECT_EQ(::pclose(pipe), 0);
    EXPECT_EQ(shown, declared);
    EXPECT_EQ(declared.size(), 91u);
}

}  // namespace
}  // namespace motionrack::mcx314lib_test
