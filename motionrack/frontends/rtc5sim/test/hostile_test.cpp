// Calls the C library with invalid numbers, positions, words and files: each call gives a sentence and the board's
// error bits and leaves the state unchanged.
#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <motionrack/cards/rtc5/model/correction.hpp>
#include <motionrack/frontends/rtc5sim/test/session.hpp>

namespace motionrack::rtc5sim_test {
namespace {

using testing::HasSubstr;
constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();

/// Checks that the previous call was rejected with this bit and a sentence that contains `words`.
void refused(UINT bit, const char* words) {
    EXPECT_EQ(get_last_error(), bit) << rtc5sim_last_error();
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr(words));
    rtc5sim_clear_error();
}

TEST(Rtc5simHostile, NonFiniteNumbersAreNotAddedToTheList) {
    const Session session;
    const UINT before = get_input_pointer();
    void (*const calls[])(double) = {[](double v) { arc_abs(0, 0, v); },
                                     [](double v) { timed_mark_abs(0, 0, v); },
                                     [](double v) { set_jump_speed(v); },
                                     [](double v) { set_fly_x(v); },
                                     [](double v) { set_fly_rot(v); },
                                     [](double v) { set_fly_2d(1, v); },
                                     [](double v) { set_encoder_speed(0, v, 0); },
                                     [](double v) { set_encoder_speed(0, 100, v); },
                                     [](double v) { set_mcbsp_in_list(1, v); },
                                     [](double v) { set_mcbsp_rot_list(v); },
                                     [](double v) { set_matrix_list(1, 0, 0, v, 0); },
                                     [](double v) { set_angle_list(1, v, 0); },
                                     [](double v) { set_wobbel(1, 1, v); }};
    for (const auto call : calls)
        for (const double v : {nan, infinite, -infinite}) {
            call(v);
            refused(RTC5_PARAM_ERROR, "which is not a number; the command was not added to the list");
        }
    EXPECT_EQ(get_input_pointer(), before);
}

TEST(Rtc5simHostile, NonFiniteNumbersChangeNoSetting) {
    const Session session;
    void (*const calls[])(double) = {[](double v) { set_matrix(1, v, 0, 0, 1, 1); },
                                     [](double v) { set_angle(1, v, 1); },
                                     [](double v) { set_scale(1, v, 1); },
                                     [](double v) { set_hi(1, v, 1, 0, 0); },
                                     [](double v) { set_mcbsp_in(1, v); },
                                     [](double v) { set_mcbsp_x(v); },
                                     [](double v) { set_mcbsp_rot(v); },
                                     [](double v) { set_encoder_speed_ctrl(0, v, 0); }};
    for (const auto call : calls) {
        call(nan);
        EXPECT_EQ(get_last_error(), UINT{RTC5_PARAM_ERROR});
    }
    set_start_list(1), micro_vector_abs(500, -600, -1, -1), set_end_of_list();
    execute_list(1);
    EXPECT_EQ(rtc5sim_run(1000), 1);
    std::int32_t x = 0, y = 0;
    rtc5sim_output(1, &x, &y, nullptr);
    EXPECT_EQ(x, 500);
    EXPECT_EQ(y, -600);
}

TEST(Rtc5simHostile, SignalsChannelsAndPositionsAreChecked) {
    const Session session;
    rtc5sim_question_us(0);
    const UINT before = get_input_pointer();
    set_trigger(1, 7, 6),
        refused(RTC5_PARAM_ERROR, "set_trigger: Signal2 is 6, and the card has no signal of that number");
    set_trigger4(1, 7, 8, 20, 999), refused(RTC5_PARAM_ERROR, "set_trigger4: Signal4 is 999");
    EXPECT_EQ(get_input_pointer(), before);
    EXPECT_EQ(get_value(3), 0), refused(RTC5_PARAM_ERROR, "get_value: the card has no signal of the number 3");
    std::array<std::int32_t, 4> kept = {11, 22, 33, 44};
    const auto ptr = reinterpret_cast<ULONG_PTR>(kept.data());
    get_waveform(1, 1, ptr), refused(RTC5_PARAM_ERROR, "get_waveform: nothing was recorded");
    set_start_list(1), set_trigger(1, 7, 8), long_delay(3), set_end_of_list(), execute_list(1), rtc5sim_run(1000);
    UINT busy = 0, pos = 0;
    measurement_status(&busy, &pos);
    EXPECT_EQ(busy, 1u);
    EXPECT_EQ(pos + 1, 3u);
    get_waveform(0, 1, ptr), refused(RTC5_PARAM_ERROR, "get_waveform: Channel is 0; it must be 1 to 2");
    get_waveform(3, 1, ptr), refused(RTC5_PARAM_ERROR, "Channel is 3");
    get_waveform(1, 4, ptr), refused(RTC5_PARAM_ERROR, "Number is 4; it must be 1 to 3");
    get_waveform(1, 3, 0), refused(RTC5_PARAM_ERROR, "Ptr is a null pointer");
    EXPECT_THAT(kept, testing::ElementsAre(11, 22, 33, 44));
    get_waveform(2, 3, ptr);
    EXPECT_THAT(kept, testing::ElementsAre(0, 0, 0, 44));
    measurement_status(nullptr, &pos), refused(RTC5_PARAM_ERROR, "null pointer");
    set_mcbsp_out(7, 6), refused(RTC5_PARAM_ERROR, "set_mcbsp_out: the card has no signal of the number 6");
    set_mcbsp_out_ptr(9, ptr), refused(RTC5_PARAM_ERROR, "Number is 9; it must be 0 to 8");
    set_mcbsp_out_ptr(0x80000001, ptr), refused(RTC5_PARAM_ERROR, "Number is 2147483649");
    set_mcbsp_out_ptr(1, 0), refused(RTC5_PARAM_ERROR, "SignalPtr is a null pointer");
    mcbsp_init(3, 1), refused(RTC5_PARAM_ERROR, "XDelay is 3; it must be 0 to 2");
    mcbsp_init_spi(0, 2), refused(RTC5_PARAM_ERROR, "ClockDelay is 2");
    EXPECT_EQ(set_mcbsp_freq(0), 0u), refused(RTC5_PARAM_ERROR, "Freq is 0");
    EXPECT_EQ(set_mcbsp_freq(6'000'000), 6'000'000u);
    EXPECT_EQ(rtc5sim_sent(1, nullptr), -1);
}

TEST(Rtc5simHostile, ListsAreOpenedAndStartedWithinTheirMemoryOnly) {
    const Session session;
    rtc5sim_question_us(0);
    EXPECT_EQ(load_list(1, 1 << 20), 0u),
        refused(RTC5_PARAM_ERROR, "load_list: the list position is 1048576; it must be 0 to 1048575");
    set_start_list_pos(2, 0xFFFFFFFF), refused(RTC5_PARAM_ERROR, "set_start_list_pos: the list position is 4294967295");
    execute_list_pos(1, 1 << 20), refused(RTC5_PARAM_ERROR, "execute_list_pos: the list position is 1048576");
    load_sub(1024), refused(RTC5_PARAM_ERROR, "load_sub: subroutine 1024 must be 0 to 1023");
    config_list(2'000'000, 1), refused(RTC5_PARAM_ERROR, "do not fit a memory of 1048576");
    config_list(0, 10), refused(RTC5_PARAM_ERROR, "config_list: lists of 0 and 10");
    sub_call(1024), list_call(1 << 20), refused(RTC5_PARAM_ERROR, "list_call: Pos is 1048576");
    set_start_list(1), long_delay(100), set_end_of_list(), execute_list(1);
    rtc5sim_advance_us(50);
    execute_list(2), refused(RTC5_BUSY, "execute_list: a list is running");
    config_list(10, 10), refused(RTC5_BUSY, "config_list: a list is running");
    EXPECT_EQ(load_list(1, 0), 0u);
    EXPECT_EQ(get_last_error(), 0u) << "an answer, no error";
    EXPECT_EQ(get_list_space(), 0u);
    mark_abs(1, 2), refused(RTC5_REJECTED, "mark_abs: no list is open");
    config_list(4, 4);
    stop_execution();
    config_list(4, 0xFFFFFFFF);
    set_start_list(2);
    EXPECT_EQ(get_list_space(), (1u << 20) - 4);
}

TEST(Rtc5simHostile, WordsOfAnotherTypeDoNotMoveTheSpot) {
    const Session session;
    set_multi_mcbsp_in(0, 0, 0);
    for (const std::uint32_t type : {3u, 4u, 5u, 6u, 7u})
        rtc5sim_receive(1, 1'000'000u << 3 | type), rtc5sim_advance_us(10);
    std::int32_t x = 1, y = 1;
    rtc5sim_output(1, &x, &y, nullptr);
    EXPECT_EQ(x, 0);
    EXPECT_EQ(y, 0);
    EXPECT_EQ(read_multi_mcbsp(3), 1'000'000);
    set_mcbsp_matrix();
    for (const std::uint32_t word : {0x80000000u, 0x7FFFFFFFu, 0xFFFFFFFFu, 0u, 3u}) {
        rtc5sim_receive(1, word), rtc5sim_advance_us(20);
        apply_mcbsp(1, 1);
        rtc5sim_advance_us(10);
        rtc5sim_output(1, &x, &y, nullptr);
        EXPECT_LE(std::abs(x), 524288);
        EXPECT_LE(std::abs(y), 524288);
    }
    EXPECT_EQ(get_error(), 0u);
}

TEST(Rtc5simHostile, InvalidTableFilesLeaveTheOldTable) {
    const Session session;
    const auto folder = std::filesystem::temp_directory_path() / ("rtc5sim_hostile_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    rtc5::CorrectionFile table = rtc5::one_to_one();
    table.header[1] = 4711;
    const auto bytes = rtc5::written_ct5(table);
    const std::string good(bytes.begin(), bytes.end());
    const auto load = [&](const std::string& content) {
        const std::string path = (folder / "some.ct5").string();
        std::ofstream(path, std::ios::binary) << content;
        return load_correction_file(path.c_str(), 1, 2);
    };
    EXPECT_EQ(load(good), 0u);
    std::string turned = good;
    turned[100'000] = static_cast<char>(turned[100'000] ^ 1);
    for (const std::string& bad : {std::string(), std::string("[Fly2DTable1]\n0 0 0 0\n"), good.substr(0, 1'000'000),
                                   good + "x", std::string(good.size(), '\xFF'), turned}) {
        EXPECT_EQ(load(bad), 1u) << bad.size();
        refused(RTC5_PARAM_ERROR, "some.ct5");
        EXPECT_EQ(get_table_para(1, 1), 4711);
    }
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace motionrack::rtc5sim_test
