#include <gtest/gtest.h>

#include <motionrack/operate/clock_pacer.hpp>
#include <vector>

namespace motionrack::operate {
namespace {

/// A computer's clock that advances only by sleeps or on request.
class SleepingClock final : public live::Clock {
  public:
    Instant now() const override { return now_; }
    void sleep(Duration duration) override {
        now_ += duration + too_long;
        slept += duration;
    }
    bool wait_readable(int, Duration) override { return false; }
    void pass(Duration duration) { now_ += duration; }

    Duration slept{0};
    Duration too_long{0};  ///< additional duration of a sleep

  private:
    Instant now_{whole_seconds(1000)};
};

/// Requests one slice until it may run; returns the number of requests.
int let_on(ClockPacer& pacer, Instant now) {
    int asked = 1;
    while (!pacer.pace(now)) ++asked;
    return asked;
}

TEST(ClockPacer, FollowsTheComputersClockWithoutDrift) {
    SleepingClock clock;
    clock.too_long = microseconds(70);
    ClockPacer pacer(clock, ClockMode::real, 1);
    const Instant begin = clock.now();
    for (int i = 0; i <= 5000; ++i) let_on(pacer, milliseconds(2) * i);
    EXPECT_EQ(clock.now() - begin, whole_seconds(10) + microseconds(70));
    EXPECT_EQ(pacer.lateness().max(), microseconds(70));
    EXPECT_EQ(pacer.lateness().count(), 5001);
}

TEST(ClockPacer, ScalesTime) {
    for (const double factor : {0.001, 0.1, 3.0, 1000.0}) {
        SleepingClock clock;
        ClockPacer pacer(clock, ClockMode::real, factor);
        const Instant begin = clock.now();
        for (int i = 0; i <= 50; ++i) let_on(pacer, milliseconds(2) * i);
        EXPECT_NEAR(to_seconds(clock.now() - begin), 0.1 / factor, 1e-6 / factor) << factor;
    }
}

TEST(ClockPacer, WaitsInPartsSoThatEveryCommandIsProcessed) {
    SleepingClock clock;
    ClockPacer pacer(clock, ClockMode::real, 0.01);
    EXPECT_EQ(let_on(pacer, milliseconds(0)), 1);
    EXPECT_EQ(let_on(pacer, milliseconds(2)), 40);  // 200 ms, 5 ms at a time
}

TEST(ClockPacer, CatchesUpASmallDelayAndSkipsALargeOne) {
    SleepingClock clock;
    ClockPacer pacer(clock, ClockMode::real, 1);
    let_on(pacer, Instant{0});
    clock.pass(milliseconds(100));
    for (int i = 1; i <= 50; ++i) let_on(pacer, milliseconds(2) * i);
    EXPECT_EQ(clock.slept, Duration{0});
    EXPECT_EQ(pacer.lost(), Duration{0});
    EXPECT_EQ(pacer.lateness().max(), milliseconds(98));
    clock.pass(whole_seconds(3));
    let_on(pacer, milliseconds(102));
    EXPECT_EQ(pacer.lost(), whole_seconds(3) - milliseconds(2));
    let_on(pacer, milliseconds(104));
    EXPECT_EQ(clock.slept, milliseconds(2));
}

TEST(ClockPacer, PausesAdvancesAndContinuesWithoutAJump) {
    SleepingClock clock;
    ClockPacer pacer(clock, ClockMode::paused, 1);
    EXPECT_FALSE(pacer.pace(Instant{0}));
    EXPECT_FALSE(pacer.pace(Instant{0}));
    ASSERT_TRUE(pacer.step(milliseconds(4)));
    EXPECT_TRUE(pacer.pace(Instant{0}));
    EXPECT_TRUE(pacer.pace(milliseconds(2)));
    EXPECT_FALSE(pacer.pace(milliseconds(4)));
    clock.pass(whole_seconds(60));
    ASSERT_TRUE(pacer.set(ClockMode::real, 1));
    const Instant begin = clock.now();
    for (int i = 2; i <= 12; ++i) let_on(pacer, milliseconds(2) * i);
    EXPECT_EQ(clock.now() - begin, milliseconds(20));
    EXPECT_EQ(pacer.lost(), Duration{0});
}

TEST(ClockPacer, NeverWaitsWhenUnthrottled) {
    SleepingClock clock;
    ClockPacer pacer(clock, ClockMode::unthrottled, 1);
    for (int i = 0; i < 1000; ++i) EXPECT_TRUE(pacer.pace(whole_seconds(i)));
    EXPECT_EQ(clock.slept, Duration{0});
    EXPECT_EQ(pacer.lateness().count(), 0);
}

TEST(ClockPacer, RejectsInvalidFactorsAndSteps) {
    SleepingClock clock;
    ClockPacer pacer(clock, ClockMode::real, 1);
    for (const double factor : {0.0, -1.0, 1001.0, 0.0 / 0.0 * 1.0}) {
        const Result<void> set = pacer.set(ClockMode::real, factor);
        ASSERT_FALSE(set);
        EXPECT_NE(set.error().message.find("0.001 to 1000"), std::string::npos) << set.error().message;
    }
    EXPECT_FALSE(pacer.step(milliseconds(1)));
    ASSERT_TRUE(pacer.set(ClockMode::paused, 1));
    EXPECT_FALSE(pacer.step(Duration{0}));
    EXPECT_FALSE(pacer.step(whole_seconds(3601)));
}

TEST(Lateness, CountsLateEventsByTheirLateness) {
    Lateness lateness;
    EXPECT_EQ(lateness.within(0.99), Duration{0});
    for (int i = 1; i <= 1000; ++i) lateness.add(microseconds(i));
    EXPECT_EQ(lateness.within(0.5), microseconds(500));
    EXPECT_EQ(lateness.within(0.99), microseconds(1000));
    EXPECT_EQ(lateness.within(0.98), microseconds(980));
    EXPECT_EQ(lateness.within(1), microseconds(1000));
    lateness.add(whole_seconds(7));
    EXPECT_EQ(lateness.within(1), whole_seconds(7));
    EXPECT_EQ(lateness.max(), whole_seconds(7));
}

}  // namespace
}  // namespace motionrack::operate
