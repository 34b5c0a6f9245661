// The slope designer: tables contain the requested values, and the planned motion is that of the card.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <motionrack/cards/databoard4002/driver/driver.hpp>
#include <motionrack/cards/databoard4002/driver/slope.hpp>
#include <motionrack/cards/databoard4002/test/host.hpp>

namespace motionrack::databoard4002 {
namespace {

using ::testing::HasSubstr;

/// The tables of the example in Basic, p. 38: 24 pairs of speed and position (in units of 256 counts) for each half.
constexpr int basic_deceleration[24][2] = {
    {14288, 1},   {15892, 6},   {16002, 8},   {16116, 15},  {16178, 30},  {16216, 35},  {16244, 40},  {16262, 45},
    {16278, 50},  {16288, 60},  {16298, 70},  {16305, 85},  {16312, 100}, {16317, 115}, {16322, 130}, {16326, 145},
    {16330, 160}, {16333, 180}, {16336, 200}, {16337, 225}, {16338, 250}, {16339, 285}, {16340, 320}, {16341, 370}};
constexpr int basic_acceleration[24][2] = {
    {14288, 1},   {15892, 12},  {16002, 16},  {16116, 22},  {16178, 30},  {16216, 35},  {16244, 40},  {16262, 50},
    {16278, 60},  {16288, 70},  {16298, 80},  {16305, 105}, {16312, 130}, {16317, 150}, {16322, 180}, {16326, 215},
    {16330, 250}, {16333, 290}, {16336, 330}, {16337, 365}, {16338, 400}, {16339, 450}, {16340, 500}, {16341, 600}};

TEST(Databoard4002Slope, TheTableOfTheBasicExampleIsDrivenIntervalByInterval) {
    Host host;
    host.start();
    host.command('S');
    for (const auto* half : {&basic_deceleration, &basic_acceleration}) {
        for (const auto& row : *half) {
            host.number(row[0], 2);
            host.number(256 * row[1], 3);
        }
    }
    host.command('O');
    constexpr std::int64_t target = 300'000;
    host.command('P', target, 3);
    host.command('G');
    std::vector<int> rates;
    for (bool begun = false; !begun || host.card.moving(); begun = begun || host.card.moving()) {
        host.run(microseconds(200));
        const int rate = host.card.output_rate();
        if (rate != 0 && (rates.empty() || rates.back() != rate)) rates.push_back(rate);
    }
    std::vector<int> expected;
    for (const auto& row : basic_acceleration) expected.push_back(row[0]);
    for (int i = 22; i >= 0; --i) expected.push_back(basic_deceleration[i][0]);
    EXPECT_EQ(rates, expected);
    EXPECT_EQ(host.card.position(), target);
}

RC_GTEST_PROP(Databoard4002Slope, RateForIsTheGreatestRateThatIsNotFaster, ()) {
    SpeedScale scale;
    scale.analog = *rc::gen::arbitrary<bool>();
    scale.counts_per_volt = 12'000;
    scale.counts_per_pulse = *rc::gen::element(0.5, 1.0, 4.0);
    const double wanted = *rc::gen::inRange(1, 12'000'000) * 1e-2;
    const int rate = scale.rate_for(wanted);
    RC_ASSERT(scale.speed(rate) <= wanted);
    RC_ASSERT(rate == max_rate || scale.speed(rate + 1) > wanted);
}

RC_GTEST_PROP(Databoard4002Slope, TablesAreSoundAndTheirAverageRampsAreThoseAskedFor, ()) {
    SlopeDemand d;
    d.top_speed = *rc::gen::inRange(2'000, 30'000);
    d.acceleration = *rc::gen::inRange(2'000, 50'000);
    d.deceleration = *rc::gen::inRange(2'000, 50'000);
    d.load = *rc::gen::element(0.0, 0.5, 3.0);
    const SpeedScale scale;
    const auto table = design_slope(d, scale);
    RC_ASSERT(table.has_value());
    int interval = 0;
    RC_ASSERT(table->flaw(interval) == SlopeFlaw::none);
    const auto motion = motion_of(*table, 2'000'000, max_rate, scale);
    RC_ASSERT(motion.has_value());
    RC_ASSERT(std::fabs(motion->top_speed - d.top_speed) < 0.08 * d.top_speed);
    const auto ramp_time = [&](double a) { return d.top_speed / (a / (1 + d.load)) * 23 / 24; };
    double up = 0, down = 0;
    bool top = false;
    for (const SlopeLeg& leg : motion->legs) {
        if (leg.speed == motion->top_speed)
            top = true;
        else
            (top ? down : up) += leg.duration_s;
    }
    RC_ASSERT(std::fabs(up - ramp_time(d.acceleration)) < 0.1 * ramp_time(d.acceleration) + 0.01);
    RC_ASSERT(std::fabs(down - ramp_time(d.deceleration)) < 0.1 * ramp_time(d.deceleration) + 0.01);
}

TEST(Databoard4002Slope, ThePlannedMotionIsTheOneThatTheCardMakes) {
    for (const auto& [distance, limit] :
         {std::pair{100'000, max_rate}, {3'000, max_rate}, {40'000, 16'300}, {17, max_rate}}) {
        Host host;
        host.start();
        Driver driver(host.port, host.port);
        ASSERT_TRUE(driver.connect());
        const SpeedScale scale;
        const SlopeTable table =
            *design_slope({.top_speed = 9'000, .acceleration = 12'000, .deceleration = 7'000}, scale);
        ASSERT_TRUE(driver.set_slope(table));
        ASSERT_TRUE(driver.on_regulation());
        ASSERT_TRUE(driver.set_rate(limit));
        const SlopeMotion planned = *motion_of(table, distance, limit, scale);
        ASSERT_TRUE(driver.set_target(-distance));
        ASSERT_TRUE(driver.go());
        host.wait_ready();
        const Instant start = host.kernel.now();
        while (host.card.moving()) host.run(microseconds(50));
        EXPECT_EQ(host.card.position(), -distance);
        EXPECT_NEAR(to_seconds(host.kernel.now() - start), planned.duration_s, 0.002 + 0.001 * planned.duration_s)
            << distance;
    }
}

TEST(Databoard4002Slope, LegsAreContiguousAndTheSeriesHasTheirCorners) {
    const SpeedScale scale;
    const SlopeTable table = *design_slope({.top_speed = 9'000, .acceleration = 12'000, .deceleration = 7'000}, scale);
    const SlopeMotion motion = *motion_of(table, 50'000, max_rate, scale);
    std::int64_t at = 0;
    double time = 0;
    for (const SlopeLeg& leg : motion.legs) {
        EXPECT_EQ(leg.from, at);
        EXPECT_DOUBLE_EQ(leg.start_s, time);
        at = leg.to;
        time += leg.duration_s;
    }
    EXPECT_EQ(at, 50'000);
    EXPECT_NEAR(time, motion.duration_s, 1e-9);
    EXPECT_GT(motion.decelerating, motion.accelerating);
    const SlopeSeries series = series_of(motion);
    EXPECT_EQ(series.seconds.size(), 2 * motion.legs.size() + 2);
    EXPECT_EQ(series.speed.front(), 0);
    EXPECT_EQ(series.speed.back(), 0);
    EXPECT_EQ(series.position.back(), 50'000);
    EXPECT_TRUE(motion_of(table, 0, max_rate, scale)->legs.empty());
}

TEST(Databoard4002Slope, RejectsImpossibleSlopesWithTheValueAndTheLimit) {
    const SpeedScale scale;
    EXPECT_THAT(design_slope({.top_speed = 500'000}, scale).error().message,
                HasSubstr("500000 counts/s, but this machine reaches 400000"));
    EXPECT_FALSE(design_slope({.top_speed = 0.0 / 1.0}, scale));
    EXPECT_FALSE(design_slope({.acceleration = std::nan("")}, scale));
    EXPECT_FALSE(design_slope({.load = -1}, scale));
    EXPECT_FALSE(design_slope({.top_speed = 100, .creep_speed = 100}, scale));
    EXPECT_THAT(design_slope({.top_speed = 100}, scale).error().message, HasSubstr("slowest rate gives 24.41"));
    EXPECT_THAT(design_slope({.top_speed = 100'000, .acceleration = 100}, scale).error().message,
                HasSubstr("is longer than 8388607"));
    EXPECT_FALSE(motion_of(SlopeTable{}, 100, max_rate, scale));
    EXPECT_FALSE(motion_of(SlopeTable{}, -1, max_rate, scale));
}

}  // namespace
}  // namespace motionrack::databoard4002
