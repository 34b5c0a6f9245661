// Tests that the scale of a correction by position words, determined as in the manual (1.10 d, page 198), is right:
// read_mcbsp, move, read_mcbsp, i = (end - start) / distance, scale = K / i. A mark is then at its intended position on
// the part.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <motionrack/frontends/rtc5sim/test/session.hpp>

namespace motionrack::rtc5sim_test {
namespace {

using testing::HasSubstr;

constexpr double k = 5184;  // bits/mm

/// Returns a rack file with a belt that is stationary at first; its source sends one axis, or X and Y in one word.
std::string standing_belt(double direction_deg, bool two_axes) {
    return fmt::format(
        "[card.scan]\ntype = \"rtc5\"\nlist_memory = 16000\n"
        "[belt.line]\ncard = \"scan\"\nvelocity_mm_s = 0\ndirection_deg = {}\n"
        "[belt.line.sender]\nbits_per_mm = 200\ntwo_axes = {}\n"
        "[scanner.head]\ncard = \"scan\"\nconveyor = \"line\"\nbits_per_mm = {}\n",
        direction_deg, two_axes, k);
}

double true_of(const char* name) {
    double value = NAN;
    EXPECT_EQ(rtc5sim_part_get(name, &value), 0) << rtc5sim_last_error();
    return value;
}

void drive(double mm_s) {
    ASSERT_EQ(rtc5sim_part_set("line.speed_mm_s", mm_s), 0) << rtc5sim_last_error();
}

struct Mm {
    double x = 0, y = 0;
};

/// Returns the distance that the part has moved, as measured with a ruler.
Mm gone(double direction_deg) {
    const double way = true_of("line.position_mm"), angle = direction_deg * std::acos(-1.0) / 180;
    return {way * std::cos(angle), way * std::sin(angle)};
}

void run_list() {
    set_end_of_list();
    execute_list(1);
    UINT status = 1, position = 0;
    while (status & 1) get_status(&status, &position);
}

/// Splits a word of two axes as described in rtc5sim.h.
Mm halves(long word) {
    return {static_cast<double>(static_cast<std::int16_t>(word & 0xFFFF)),
            static_cast<double>(static_cast<std::int16_t>(word >> 16))};
}

/// Marks a line of 10 mm from (0, 0) along X while the part passes, with the correction enabled by `correct`. Returns
/// the maximum distance of the laser from that line in part coordinates, mm.
template <class Correct>
double worst_of_a_mark(double direction_deg, Correct correct) {
    drive(100);
    set_start_list(1);
    set_mark_speed(500 * k / 1000), set_jump_speed(50'000);
    correct();
    jump_abs(0, 0), mark_abs(static_cast<long>(10 * k), 0), fly_return(0, 0);
    set_end_of_list();
    execute_list(1);
    double max_error = 0, furthest = -1e9, nearest = 1e9;
    UINT status = 1, position = 0;
    while (status & 1) {
        get_status(&status, &position);
        std::int32_t x = 0, y = 0;
        int laser = 0;
        rtc5sim_output(1, &x, &y, &laser);
        if (laser == 0) continue;
        const Mm way = gone(direction_deg);
        const double on_x = x / k - way.x, on_y = y / k - way.y;
        max_error = std::fmax(max_error, std::fabs(on_y));
        furthest = std::fmax(furthest, on_x), nearest = std::fmin(nearest, on_x);
    }
    drive(0);
    return std::fmax(max_error, std::fmax(std::fabs(furthest - 10), std::fabs(nearest)));
}

TEST(Rtc5simCalibration, ReadingAnEmptyLocationReportsTheRequiredCommand) {
    const Session session;
    ASSERT_EQ(rtc5sim_open(standing_belt(0, false).c_str()), 0) << rtc5sim_last_error();
    drive(100);
    rtc5sim_advance_us(1000);
    EXPECT_EQ(read_mcbsp(0), 0);
    EXPECT_EQ(get_last_error(), UINT{RTC5_REJECTED});
    EXPECT_STREQ(rtc5sim_last_error(),
                 "read_mcbsp: location 0 is empty; first use "
                 "set_fly_x_pos, set_fly_y_pos or set_fly_rot_pos in a list (with any scale), or set_mcbsp_in, "
                 "set_multi_mcbsp_in or get_mcbsp");
    for (const UINT location : {1u, 2u, 3u}) {
        rtc5sim_clear_error();
        EXPECT_EQ(read_mcbsp(location), 0);
        EXPECT_EQ(get_last_error(), UINT{RTC5_REJECTED});
        EXPECT_THAT(rtc5sim_last_error(), HasSubstr("first use set_mcbsp_in with Mode"));
    }
    EXPECT_EQ(get_error(), UINT{RTC5_REJECTED});
    set_mcbsp_in(3, 0);
    for (const UINT location : {0u, 1u, 2u, 3u}) {
        EXPECT_NE(read_mcbsp(location) != 0, location == 2) << "the high half of a small word is 0, and there";
        EXPECT_EQ(get_last_error(), 0u) << location;
    }
}

TEST(Rtc5simCalibration, ReportsAMissingWordWithoutASender) {
    const Session session;
    set_mcbsp_in(1, 0);
    EXPECT_EQ(read_mcbsp(0), 0);
    EXPECT_EQ(get_last_error(), UINT{RTC5_REJECTED});
    EXPECT_STREQ(rtc5sim_last_error(),
                 "read_mcbsp: no word was received over McBSP yet; let the sender send one first");
    EXPECT_EQ(get_mcbsp(), 0);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("get_mcbsp: no word was received over McBSP yet"));
    EXPECT_EQ(get_last_error(), UINT{RTC5_REJECTED});
    rtc5sim_question_us(0);
    rtc5sim_receive(1, 0);
    rtc5sim_advance_us(10);
    rtc5sim_clear_error();
    EXPECT_EQ(read_mcbsp(1), 0) << "a word of 0 was sent";
    EXPECT_EQ(get_last_error(), 0u);
    EXPECT_STREQ(rtc5sim_last_error(), "");
}

TEST(Rtc5simCalibration, MatchesThePrintedExampleForXAndForY) {
    for (const double direction_deg : {0.0, 90.0, 180.0}) {
        SCOPED_TRACE(direction_deg);
        const Session session;
        ASSERT_EQ(rtc5sim_open(standing_belt(direction_deg, false).c_str()), 0) << rtc5sim_last_error();
        set_start_list(1), set_fly_x_pos(0), run_list();
        const long start = read_mcbsp(0);
        const Mm from = gone(direction_deg);
        drive(100), rtc5sim_advance_us(200'000), drive(0), rtc5sim_advance_us(1000);
        const long end = read_mcbsp(0);
        const Mm to = gone(direction_deg);
        const bool along_y = direction_deg == 90;
        const double i = static_cast<double>(end - start) / (along_y ? to.y - from.y : to.x - from.x);
        EXPECT_NEAR(i, direction_deg == 180 ? -200 : 200, 0.1) << "bits/mm";
        const double scale = k / i;
        EXPECT_LT(worst_of_a_mark(direction_deg, [&] { along_y ? set_fly_y_pos(scale) : set_fly_x_pos(scale); }), 0.06)
            << "mm";
        EXPECT_GT(worst_of_a_mark(direction_deg, [] { set_fly_x_pos(0); }), 1.5) << "mm, without the correction";
        EXPECT_EQ(get_error(), 0u) << rtc5sim_last_error();
    }
}

/// Returns both increments since position 0, bits/mm.
Mm increments(double direction_deg) {
    const Mm start = halves(read_mcbsp(0)), from = gone(direction_deg);
    drive(100), rtc5sim_advance_us(300'000), drive(0), rtc5sim_advance_us(1000);
    const Mm end = halves(read_mcbsp(0)), to = gone(direction_deg);
    return {(end.x - start.x) / (to.x - from.x), (end.y - start.y) / (to.y - from.y)};
}

TEST(Rtc5simCalibration, MatchesThePrintedExampleForBothAxesOfOneWord) {
    const double direction_deg = 210;
    const Session session;
    ASSERT_EQ(rtc5sim_open(standing_belt(direction_deg, true).c_str()), 0) << rtc5sim_last_error();
    EXPECT_EQ(read_mcbsp(0), 0);
    EXPECT_EQ(get_last_error(), UINT{RTC5_REJECTED}) << "the source's first step needs what its note says";
    set_start_list(1), set_fly_x_pos(0), set_fly_y_pos(0), run_list();
    reset_error(RTC5_REJECTED);
    const Mm i = increments(direction_deg);
    EXPECT_NEAR(i.x, 200, 0.2);
    EXPECT_NEAR(i.y, 200, 0.2);
    EXPECT_LT(gone(direction_deg).y, -10) << "its half is negative";
    EXPECT_LT(worst_of_a_mark(direction_deg, [&] { set_fly_x_pos(k / i.x), set_fly_y_pos(k / i.y); }), 0.06) << "mm";
    EXPECT_GT(worst_of_a_mark(direction_deg, [&] { set_fly_x_pos(k / i.x), set_fly_y_pos(0); }), 0.5)
        << "one axis takes the whole word";
    EXPECT_EQ(get_error(), 0u) << rtc5sim_last_error();
}

TEST(Rtc5simCalibration, SetMcbspInStoresTheWordAtLocation0AndEachAxisSeparatelyAlsoInAList) {
    const double direction_deg = 30;
    for (const bool in_list : {false, true}) {
        SCOPED_TRACE(in_list);
        const Session session;
        ASSERT_EQ(rtc5sim_open(standing_belt(direction_deg, true).c_str()), 0) << rtc5sim_last_error();
        if (in_list) {
            set_start_list(1), set_mcbsp_in_list(3, 0), run_list();
        } else {
            set_mcbsp_in(3, 0);
        }
        const Mm i = increments(direction_deg);
        EXPECT_NEAR(i.x, 200, 0.2);
        EXPECT_NEAR(i.y, 200, 0.2);
        const long word = read_mcbsp(0);
        EXPECT_EQ(read_mcbsp(3), word);
        EXPECT_EQ(static_cast<double>(read_mcbsp(1)), halves(word).x);
        EXPECT_EQ(static_cast<double>(read_mcbsp(2)), halves(word).y);
        EXPECT_GT(read_mcbsp(2), 1000);
        EXPECT_LT(worst_of_a_mark(direction_deg, [&] { set_mcbsp_in_list(3, k / i.x); }), 0.06) << "mm";
        rtc5sim_advance_us(1000);
        EXPECT_EQ(halves(read_mcbsp(0)).x, static_cast<double>(read_mcbsp(1))) << "after fly_return, too";
        EXPECT_EQ(get_error(), 0u) << rtc5sim_last_error();
    }
}

}  // namespace
}  // namespace motionrack::rtc5sim_test
