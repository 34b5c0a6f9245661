// Breaches are found in the pulses alone, and each is reported once with its maximum.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/rack/breaches.hpp>

namespace motionrack::rack {
namespace {

constexpr double start_hz = 1280, accel_hz = 640'000;  // 2 mm/s and 1,000 mm/s2 at 640 pulses per mm

/// Samples a motion whose pulse count at `t` seconds is `position(t)`, for 0.4 s. Returns the largest velocity step
/// found; sets `times` to the number of steps.
template <class Place>
JumpWatch::Jump sample_jump(Place position, int& times, Duration period = milliseconds(1)) {
    JumpWatch watch(start_hz, accel_hz, period);
    JumpWatch::Jump worst;
    times = 0;
    for (double t = 0; t < 0.4; t += to_seconds(period)) {
        const JumpWatch::Jump jump = watch.sample(static_cast<std::int64_t>(std::floor(position(t))));
        times += jump.first;
        if (jump.hz > worst.hz) worst = jump;
    }
    return worst;
}

TEST(JumpWatch, AcceptsRampsAndStarts) {
    int times = 0;
    const auto ramp = [](double t) {
        const double v = start_hz / 2 + accel_hz * std::min(t, 0.1);
        return t < 0.1 ? t * (start_hz / 2 + v) / 2 : 0.1 * (start_hz / 2 + v) / 2 + (t - 0.1) * v;
    };
    EXPECT_EQ(sample_jump(ramp, times).hz, 0);
    EXPECT_EQ(times, 0);
    EXPECT_EQ(sample_jump([](double t) { return t < 0.2 ? 0 : (t - 0.2) * start_hz; }, times).hz, 0) << "a start";
    EXPECT_EQ(sample_jump([](double t) { return std::fabs(t - 0.2) * start_hz / 2; }, times).hz, 0) << "and a way back";
}

TEST(JumpWatch, FindsAStopAtOnceWhateverThePeriod) {
    for (const Duration period : {microseconds(100), microseconds(500), milliseconds(1), milliseconds(2)}) {
        int times = 0;
        const JumpWatch::Jump jump = sample_jump([](double t) { return std::min(t, 0.2) * 55'000; }, times, period);
        EXPECT_NEAR(jump.hz, 55'000, 4'500);
        EXPECT_EQ(times, 1);
    }
}

TEST(JumpWatch, FindsAStopOfASlowAxisAtEachInstantOfItsPeriod) {
    constexpr double from_hz = 5'000, slow_accel_hz = 320'000;
    for (double phase = 0; phase < 1e-3; phase += 5e-5) {
        JumpWatch watch(start_hz, slow_accel_hz, milliseconds(1));
        double found = 0;
        for (int k = 0; k < 400; ++k)
            found = std::max(
                found,
                watch.sample(static_cast<std::int64_t>(std::floor(std::min(k * 1e-3, 0.2 + phase) * from_hz))).hz);
        EXPECT_GT(found, 0) << phase;
    }
}

TEST(JumpWatch, FindsNothingInSamplesThatAreTooRare) {
    int times = 0;
    EXPECT_EQ(sample_jump([](double t) { return std::min(t, 0.2) * 55'000; }, times, milliseconds(5)).hz, 0);
}

TEST(Breach, IsKeptOnceAnAxisWithItsMaximumAndReportedInASentence) {
    Breaches breaches;
    Breach jump;
    jump.axis = 0;
    jump.value = 40;
    jump.limit = 2;
    jump.line = 12;
    jump.at = milliseconds(3512);
    jump.position = {10, 0, 80};
    breaches.add(jump);
    jump.value = 84;
    breaches.add(jump);
    jump.axis = 1;
    breaches.add(jump);
    ASSERT_EQ(breaches.all().size(), 2u);
    EXPECT_EQ(breaches.all()[0].times, 2);
    EXPECT_EQ(sentence_of(breaches.all()[0]),
              "in line 12, at 3.512000 s and X 10.000, Y 0.000, Z 80.000 the velocity step of X was 84.0 mm/s, above "
              "its maximum of 2 mm/s (max_velocity_step); the worst of 2");
}

}  // namespace
}  // namespace motionrack::rack
