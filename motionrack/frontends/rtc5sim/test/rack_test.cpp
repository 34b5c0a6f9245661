// Tests of the cards of a rack through the C library: their wires, their time, the parts of the rack.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <motionrack/frontends/rtc5sim/test/session.hpp>
#include <string>

namespace motionrack::rtc5sim_test {
namespace {

using testing::HasSubstr;

constexpr const char* line = R"([card.scan]
type = "rtc5"
list_memory = 16000
[card.other]
type = "rtc5"
list_memory = 16000
[belt.line]
card = "scan"
velocity_mm_s = 100
counts_per_mm = 1000
[belt.line.parts]
part_pitch_mm = 50
first_part_mm = 5
[scanner.head]
card = "scan"
conveyor = "line"
bits_per_mm = 5184
)";

double part(const char* name) {
    double value = NAN;
    EXPECT_EQ(rtc5sim_part_get(name, &value), 0) << rtc5sim_last_error();
    return value;
}

void load_square(double scale) {
    set_start_list(1);
    set_mark_speed(2592), set_jump_speed(50'000);
    if (scale != 0) set_fly_x(scale);
    mark_abs(51840, 0), mark_abs(51840, 51840), mark_abs(0, 51840), mark_abs(0, 0);
    if (scale != 0) fly_return(0, 0);
    set_end_of_list();
}

TEST(Rtc5simRack, AJobRunsOnTheWiresAndMarksThePart) {
    for (const double scale : {0.0, 5.184}) {
        Session session;
        ASSERT_EQ(rtc5sim_open(line), 0) << rtc5sim_last_error();
        EXPECT_EQ(rtc5_count_cards(), 2u);
        load_square(scale);
        execute_list(1);
        UINT status = 1, position = 0;
        while (status & 1) get_status(&status, &position);
        EXPECT_STREQ(rtc5sim_last_error(), "");
        EXPECT_NEAR(part("head.marked_mm"), scale != 0 ? 40 : 8 + 12 + 2 * std::hypot(10, 2), 0.05) << scale;
        EXPECT_NEAR(static_cast<double>(rtc5sim_now_us()), 80'000, 1'500);
        EXPECT_NEAR(part("line.position_mm"), static_cast<double>(rtc5sim_now_us()) * 1e-4, 1e-6);
        EXPECT_EQ(session.card[0].x.size(), session.card[1].x.size()) << "time is one for all cards";
        EXPECT_NEAR(*std::max_element(session.card[0].y.begin(), session.card[0].y.end()), 51'840, 1);
    }
}

TEST(Rtc5simRack, ATimeBeyondTheLimitOfACallIsRefused) {
    const Session session;
    ASSERT_EQ(rtc5sim_open(line), 0) << rtc5sim_last_error();
    for (const std::int64_t us :
         {std::int64_t{1'000'000'000'010}, std::int64_t{18'446'744'073'709'560},  // 2^64 ns and some
          std::numeric_limits<std::int64_t>::max() / 10 * 10}) {
        EXPECT_EQ(rtc5sim_advance_us(us), -1) << us;
        EXPECT_THAT(rtc5sim_last_error(), HasSubstr(std::to_string(us) + " us; on the cards of a rack it must be 0 to "
                                                                         "1000000000000 us"));
    }
    EXPECT_EQ(rtc5sim_now_us(), 0);
}

TEST(Rtc5simRack, TheEncoderFollowsTheBeltAndPartsStartTheList) {
    const Session session;
    ASSERT_EQ(rtc5sim_open(line), 0);
    load_square(0);
    set_control_mode(1);
    ASSERT_EQ(rtc5sim_advance_us(49'000), 0);
    EXPECT_EQ(part("head.marked_mm"), 0);
    ASSERT_EQ(rtc5sim_advance_us(51'000), 0);
    EXPECT_GT(part("head.marked_mm"), 0) << "the part came at 5 mm";
    long x = 0, y = 0;
    get_encoder(&x, &y);
    EXPECT_NEAR(static_cast<double>(x), 10'000, 3);
    EXPECT_EQ(y, 0);
    ASSERT_EQ(rtc5sim_part_set("line.speed_mm_s", 0), 0);
    ASSERT_EQ(rtc5sim_run(1'000'000), 1);
    long again = 0;
    get_encoder(&again, &y);
    EXPECT_NEAR(static_cast<double>(again - x), 0, 3);
    EXPECT_EQ(rtc5sim_encoder_speed(1, 0, 1000), -1);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("rtc5sim_part_set"));
}

TEST(Rtc5simRack, AFailedOpenDoesNotChangeTheCards) {
    const Session session("3");
    EXPECT_EQ(rtc5_count_cards(), 3u);
    EXPECT_EQ(rtc5sim_open("[card.scan]\ntype = \"rtc5\"\nheight = 3\n"), -1);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("height"));
    EXPECT_EQ(rtc5sim_open("card.m = \"mcx314\""), -1);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("no card of type rtc5"));
    EXPECT_EQ(rtc5sim_open("memory:/sys/bus/pci/devices/0000:03:00.0/resource0"), -1);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("rtc5sim_open: An RTC5 has no live port: "));
    EXPECT_EQ(rtc5sim_open(nullptr), -1);
    EXPECT_EQ(rtc5_count_cards(), 3u);
    double value = 0;
    EXPECT_EQ(rtc5sim_part_get("line.speed_mm_s", &value), -1);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("rtc5sim_open"));
    ASSERT_EQ(rtc5sim_open("card.scan = \"rtc5\""), 0);
    EXPECT_EQ(rtc5_count_cards(), 1u);
    EXPECT_EQ(select_rtc(2), 0u);
    EXPECT_THAT(rtc5sim_last_error(), HasSubstr("the rack has 1 of type rtc5"));
    EXPECT_EQ(rtc5sim_close(), 0);
    EXPECT_EQ(rtc5_count_cards(), 3u);
}

}  // namespace
}  // namespace motionrack::rtc5sim_test
