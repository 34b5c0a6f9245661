// Tests of the cards, time, errors, files and inputs of the C library, and of its exported names.
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/frontends/rtc5sim/test/session.hpp>
#include <regex>
#include <set>
#include <tests/source_root.hpp>
#include <thread>

namespace motionrack::rtc5sim_test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

void load_line(long x) {
    set_start_list(1);
    set_mark_speed(1000);
    mark_abs(x, 0);
    set_end_of_list();
}

int output_x(UINT card = 1) {
    std::int32_t x = 0;
    EXPECT_EQ(rtc5sim_output(card, &x, nullptr, nullptr), 0);
    return x;
}

// ---- cards

TEST(Rtc5simCards, CommandsGoToTheirCard) {
    const Session session("3");
    EXPECT_EQ(init_rtc5_dll(), 0u);
    EXPECT_EQ(rtc5_count_cards(), 3u);
    EXPECT_EQ(select_rtc(2), 2u);
    load_line(1000);
    n_set_start_list(3, 1), n_jump_abs(3, -500, 0), n_set_end_of_list(3);
    execute_list(1), n_execute_list(3, 1);
    EXPECT_EQ(rtc5sim_run(10'000'000), 1);
    EXPECT_EQ(output_x(1), 0);
    EXPECT_EQ(output_x(2), 1000);
    EXPECT_EQ(output_x(3), -500);
    EXPECT_EQ(session.card[0].x.size(), session.card[2].x.size()) << "time is one";
}

TEST(Rtc5simCards, AMissingCardIsRejected) {
    const Session session;
    EXPECT_EQ(select_rtc(2), 0u);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("select_rtc: unknown card 2"));
    n_jump_abs(0, 1, 2);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("jump_abs: unknown card 0"));
    EXPECT_EQ(n_get_last_error(9), UINT{RTC5_ACCESS_DENIED});
    EXPECT_EQ(n_load_program_file(9, nullptr), 11u);
    EXPECT_EQ(get_error(), 0u);
}

TEST(Rtc5simCards, AWrongNumberOfCardsIsRefused) {
    const Session session("17");
    EXPECT_EQ(init_rtc5_dll(), UINT{RTC5_NO_CARD});
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("RTC5SIM_CARDS is \"17\", but the number of cards must be 1 to 16"));
    ::setenv("RTC5SIM_CARDS", "2x", 1);
    EXPECT_EQ(rtc5sim_now_us(), -1);
    ::setenv("RTC5SIM_CARDS", "2", 1);
    EXPECT_EQ(rtc5sim_now_us(), 0);
}

// ---- time

TEST(Rtc5simTime, AdvancesInALoopThatPollsTheStatusUntilTheListEnds) {
    const Session session;
    load_line(10'000);  // 10 bits per tick
    execute_list(1);
    UINT busy = 0, position = 0;
    int questions = 0;
    do get_status(&busy, &position), ++questions;
    while (busy != 0);
    EXPECT_EQ(output_x(), 10'000);
    EXPECT_EQ(rtc5sim_now_us(), questions * 10);
    EXPECT_NEAR(questions, 1000, 3);
}

TEST(Rtc5simTime, AQueryTakesTheStatedTime) {
    const Session session;
    EXPECT_EQ(rtc5sim_question_us(1000), 0);
    get_marking_info();
    EXPECT_EQ(rtc5sim_now_us(), 1000);
    jump_abs(1, 2);
    EXPECT_EQ(rtc5sim_now_us(), 1000) << "a command takes none";
    EXPECT_EQ(rtc5sim_question_us(15), -1);
    EXPECT_THAT(rtc5sim_last_error(),
                HasSubstr("the time is 15 us; it must be 0 to 1000000000 us, a multiple of 10 us"));
    EXPECT_EQ(rtc5sim_advance_us(-10), -1);
    EXPECT_EQ(rtc5sim_advance_us(std::numeric_limits<std::int64_t>::max() / 10 * 10), -1);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("the end of time"));
    EXPECT_EQ(rtc5sim_now_us(), 1000);
}

TEST(Rtc5simTime, RunningToStandstillReportsWhetherTheCardIsIdle) {
    const Session session;
    load_line(10'000);
    execute_list(1);
    EXPECT_EQ(rtc5sim_run(100), 0);
    EXPECT_EQ(rtc5sim_run(1'000'000), 1);
    EXPECT_EQ(output_x(), 10'000);
}

// ---- errors

TEST(Rtc5simErrors, RejectionsAreReportedAndLatchedInTheErrorBits) {
    const Session session;
    const UINT before = get_input_pointer();
    mark_abs(1, 2);
    EXPECT_EQ(get_last_error(), 0u);
    set_mark_speed(std::numeric_limits<double>::quiet_NaN());
    EXPECT_STREQ(rtc5sim_last_error(),
                 "set_mark_speed: Speed is nan, which is not a number; the command was not added to the list");
    EXPECT_EQ(get_last_error(), UINT{RTC5_PARAM_ERROR});
    EXPECT_EQ(get_input_pointer(), before + 1);
    EXPECT_EQ(get_last_error(), 0u);
    set_mark_speed_ctrl(std::numeric_limits<double>::infinity());
    EXPECT_STREQ(rtc5sim_last_error(), "set_mark_speed_ctrl: Speed is inf, which is not a number; nothing was changed");
    set_ext_start_delay(3'000'000'000L, 0);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("set_ext_start_delay: Delay is 3000000000; it must be"));
    simulate_encoder(4);
    get_status(nullptr, nullptr);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("get_status: The first address of the answer is a null pointer"));
    set_fly_tracking_error(65'536, 0);
    read_mcbsp(4);
    set_offset(5, 0, 0, 0);
    set_delay_mode(0, 0, 0, 0, 16'777'216);
    EXPECT_EQ(get_error(), UINT{RTC5_PARAM_ERROR});
    execute_list(1), execute_list(1);
    EXPECT_EQ(get_last_error(), UINT{RTC5_BUSY});
    config_list(2, 2);
    stop_execution();
    config_list(2, 2), set_start_list(1), mark_abs(0, 0), mark_abs(0, 0), mark_abs(0, 0);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("mark_abs: the list is full at position 2"));
    EXPECT_EQ(get_error(), UINT{RTC5_PARAM_ERROR | RTC5_BUSY | RTC5_REJECTED});
    reset_error(RTC5_BUSY | RTC5_REJECTED);
    EXPECT_EQ(get_error(), UINT{RTC5_PARAM_ERROR});
}

TEST(Rtc5simErrors, TheHandlerReceivesTheMessageAndMayCallTheLibrary) {
    const Session session;
    std::string seen;
    rtc5sim_on_error(
        [](const char* sentence, void* user) {
            static_cast<std::string*>(user)->assign(sentence);
            get_input_pointer();
        },
        &seen);
    simulate_encoder(7);
    rtc5sim_on_error(nullptr, nullptr);
    EXPECT_THAT(seen, HasSubstr("simulate_encoder: 7 is not 0 (off)"));
    std::string elsewhere = "?";
    std::thread([&] { elsewhere = rtc5sim_last_error(); }).join();
    EXPECT_EQ(elsewhere, "") << "each thread has its own";
}

TEST(Rtc5simErrors, ASampleHandlerDoesNotAffectTheRun) {
    const Session session;
    static int refused;
    refused = 0;
    rtc5sim_on_samples(
        [](void*, UINT, std::int64_t, const std::int32_t*, const std::int32_t*, const std::uint8_t*, std::size_t) {
            refused += rtc5sim_advance_us(10) == -1;
            stop_execution();
        },
        nullptr);
    load_line(1000);
    execute_list(1);
    EXPECT_EQ(rtc5sim_run(1'000'000), 1);
    EXPECT_EQ(output_x(), 1000);
    EXPECT_GT(refused, 0);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("stop_execution: it was called by the samples handler"));
}

// ---- files

class Rtc5simFiles : public testing::Test {
  protected:
    Rtc5simFiles() : folder_(fs::temp_directory_path() / ("rtc5sim_" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~Rtc5simFiles() override { fs::remove_all(folder_); }
    std::string put(const char* name, const std::string& bytes) {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
        return (folder_ / name).string();
    }
    fs::path folder_;
};

TEST_F(Rtc5simFiles, ACorrectionFileIsUsedAndADamagedOneLeavesTheOldTable) {
    const Session session;
    rtc5::CorrectionFile table = rtc5::one_to_one();
    table.header[1] = 5184;
    for (std::int32_t& x : table.x) x = std::min(x + 1000, 1'048'575);
    const auto bytes = rtc5::written_ct5(table);
    const std::string text(bytes.begin(), bytes.end());
    EXPECT_EQ(load_correction_file(put("good.ct5", text).c_str(), 2, 2), 0u) << rtc5sim_last_error();
    select_cor_table(2, 0);
    EXPECT_EQ(get_table_para(2, 1), 5184);
    EXPECT_EQ(get_head_para(1, 1), 5184);
    EXPECT_EQ(load_correction_file(put("short.ct5", text.substr(0, 99)).c_str(), 2, 2), 1u);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("short.ct5"));
    EXPECT_EQ(load_correction_file((folder_ / "none.ct5").c_str(), 2, 2), 3u);
    EXPECT_EQ(load_correction_file(folder_.c_str(), 2, 2), 3u);
    EXPECT_EQ(load_correction_file(nullptr, 5, 2), 10u);
    EXPECT_EQ(load_correction_file(nullptr, 1, 4), 10u);
    rtc5sim_advance_us(10);
    EXPECT_EQ(output_x(), 1000);
    EXPECT_EQ(get_table_para(2, 16), 0);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("get_table_para: ParaNo is 16; it must be 0 to 15"));
}

TEST_F(Rtc5simFiles, ReportsTheChecksumOfAFile) {
    const Session session;
    rtc5::CorrectionFile table = rtc5::one_to_one();
    table.header[1] = 5184;
    const auto load = [&](std::int32_t program, std::size_t turned, std::size_t turned_too) {
        table.header[10] = program;
        auto bytes = rtc5::written_ct5(table);
        for (const std::size_t place : {turned, turned_too})
            if (place != 0) bytes[place] ^= 4;
        return load_correction_file(put("some.ct5", std::string(bytes.begin(), bytes.end())).c_str(), 1, 2);
    };
    EXPECT_EQ(load(403, 0, 0), 0u) << rtc5sim_last_error();
    EXPECT_STREQ(rtc5sim_table_note(1, 1), "");
    EXPECT_EQ(load(310, rtc5::ct5_bytes - 3, rtc5::ct5_bytes - 1), 0u) << rtc5sim_last_error();
    EXPECT_THAT(rtc5sim_table_note(1, 1),
                HasSubstr("some.ct5 is from an older program, whose checksum is unknown; it was not checked."));
    EXPECT_EQ(get_last_error(), 0u);
    for (const std::size_t turned : {std::size_t{5}, std::size_t{41}, std::size_t{64}, std::size_t{900'000}})
        for (const std::int32_t program : {403, 310}) {
            EXPECT_EQ(load(program, turned, 0), 1u) << turned;
            EXPECT_THAT(rtc5sim_last_error(), HasSubstr("it is damaged. The file was not loaded")) << turned;
            EXPECT_EQ(get_last_error(), UINT{RTC5_PARAM_ERROR});
        }
    table.header[1] = 0;
    EXPECT_EQ(load(403, 0, 0), 1u);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("0 bits/mm in its header"));
    table.header[1] = 5184;
    for (std::size_t i = 0; i < table.x.size(); ++i) table.x[i] = table.y[i];
    EXPECT_EQ(load(403, 0, 0), 1u);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("its table cannot be inverted"));
    EXPECT_THAT(rtc5sim_table_note(1, 1), HasSubstr("older program")) << "the old table was kept";
    EXPECT_EQ(load_correction_file(nullptr, 1, 2), 0u);
    EXPECT_STREQ(rtc5sim_table_note(1, 1), "");
    EXPECT_STREQ(rtc5sim_table_note(1, 5), "");
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("rtc5sim_table_note: table 5 must be 1 to 4"));
}

TEST_F(Rtc5simFiles, ATableWithoutAFileIsOneToOneUpToTheEdge) {
    const Session session;
    EXPECT_EQ(load_correction_file(nullptr, 1, 2), 0u);
    select_cor_table(1, 0);
    for (const long x : {-524'288L, 520'193L, 522'001L, 524'286L, 524'287L}) {
        goto_xy(x, 0), rtc5sim_run(10'000'000);
        EXPECT_EQ(output_x(), x);
    }
}

TEST_F(Rtc5simFiles, ACompensationTableIsUsed) {
    const Session session;
    const std::string file = put("fly.txt", "[Fly2DTable3]\n0 0 50 0\n1000 0 50 0\n0 1000 50 0\n1000 1000 50 0\n");
    EXPECT_EQ(load_fly_2d_table(file.c_str(), 1), 1);
    EXPECT_EQ(load_fly_2d_table("/no/such/file", 3), 3);
    EXPECT_EQ(load_fly_2d_table(file.c_str(), 3), 0) << rtc5sim_last_error();
    set_start_list(1), set_fly_2d(2, 2), list_nop(), set_end_of_list();
    execute_list(1);
    EXPECT_EQ(rtc5sim_run(1000), 1);
    EXPECT_EQ(output_x(), 100);
}

// ---- inputs of a card

TEST(Rtc5simInputs, TheBeltMovesTheOutput) {
    const Session session;
    set_start_list(1), set_fly_x(2.5), list_nop(), set_end_of_list();
    execute_list(1);
    rtc5sim_run(1000);
    const int begin = output_x();
    EXPECT_EQ(rtc5sim_encoder_speed(1, 0, 200'000), 0);  // 2 counts per tick
    rtc5sim_advance_us(10'010);
    EXPECT_EQ(output_x() - begin, 5000);
    EXPECT_EQ(rtc5sim_encoder_speed(1, 0, 0), 0);
    rtc5sim_advance_us(10'000);
    const int stopped_at = output_x();
    EXPECT_NEAR(stopped_at - begin, 5000, 5);
    EXPECT_EQ(rtc5sim_encoder_speed(1, 2, 0), -1);
    EXPECT_EQ(rtc5sim_encoder_speed(1, 0, std::nan("")), -1);
    EXPECT_EQ(rtc5sim_encoder_speed(1, 0, 2e9), -1);
    rtc5sim_advance_us(10'000);
    EXPECT_EQ(output_x(), stopped_at);
}

TEST(Rtc5simInputs, CountsWordsStartsAndStopsArrive) {
    const Session session;
    EXPECT_EQ(rtc5sim_encoder_count(1, 1, -77), 0);
    long x = 0, y = 0;
    get_encoder(&x, &y);
    EXPECT_EQ(x, 0);
    EXPECT_EQ(y, -77);
    set_start_list(1), set_fly_x_pos(0.5), long_delay(1000), set_end_of_list();
    set_control_mode(1);
    EXPECT_EQ(rtc5sim_start(1), 0);
    EXPECT_EQ(rtc5sim_receive(1, 1000), 0);
    rtc5sim_advance_us(100);
    EXPECT_EQ(output_x(), 500);
    EXPECT_EQ(read_mcbsp(0), 1000);
    EXPECT_EQ(rtc5sim_stop(1), 0);
    UINT busy = 1, position = 0;
    get_status(&busy, &position);
    EXPECT_EQ(busy, 0u);
    EXPECT_EQ(get_startstop_info(), 2u | 8u | 16u | 512u);
}

TEST(Rtc5simInputs, FlagsHaveNames) {
    EXPECT_STREQ(rtc5sim_marking_info_text(0), "");
    EXPECT_STREQ(rtc5sim_marking_info_text(0x42),
                 "FLY_X_OVERFLOW: the corrected X was above 524287\nLIMIT_Y_MIN: the corrected Y was below Ymin\n");
}

// ---- names

const std::string header = source_dir() + "/motionrack/frontends/rtc5sim/rtc5sim.h";

std::set<std::string> declared_functions(const std::string& path) {
    std::ifstream file(path);
    std::set<std::string> out;
    const std::regex function(R"(^RTC5_API [^(]*\b(\w+)\()");
    std::smatch match;
    for (std::string line; std::getline(file, line);)
        if (std::regex_search(line, match, function)) out.insert(match[1]);
    return out;
}

TEST(Rtc5simNames, ExportsTheFunctionsOfItsHeadersOnly) {
    std::set<std::string> all = declared_functions(header);
    EXPECT_GT(all.size(), 130u);
    all.merge(declared_functions(source_dir() + "/motionrack/frontends/rtc5sim/rtc5sim_virtual.h"));
    all.merge(declared_functions(RTC5SIM_CARDS));
    std::FILE* pipe = ::popen("nm -D --defined-only --format=just-symbols '" RTC5SIM_LIBRARY "'", "r");
    ASSERT_NE(pipe, nullptr);
    std::set<std::string> shown;
    std::array<char, 512> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), pipe) != nullptr) {
        const std::string name = line.data();
        shown.insert(name.substr(0, name.find_last_not_of('\n') + 1));
    }
    EXPECT_EQ(::pclose(pipe), 0);
    EXPECT_EQ(shown, all);
}

TEST(Rtc5simNames, EachCommandHasAVariantWithACardNumber) {
    const std::set<std::string> of_process = {"init_rtc5_dll", "free_rtc5_dll", "rtc5_count_cards", "select_rtc"};
    std::set<std::string> wanted;
    for (const std::string& name : declared_functions(header))
        if (of_process.count(name) == 0 && name.rfind("rtc5sim_", 0) != 0) wanted.insert("n_" + name);
    EXPECT_EQ(declared_functions(RTC5SIM_CARDS), wanted);
}

}  // namespace
}  // namespace motionrack::rtc5sim_test
