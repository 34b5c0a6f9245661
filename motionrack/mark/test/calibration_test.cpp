// Tests of calibrations: the numbers of the formulas, and the settings that a simulated machine really has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <motionrack/mark/calibration.hpp>
#include <motionrack/mark/run.hpp>

namespace motionrack::mark {
namespace {

TEST(Calibration, ScaleFromTwoReadingsAndADistance) {
    const auto out = calibrate_scale({.reading1 = 1000,
                                      .reading2 = 51'000,
                                      .distance_mm = 50,
                                      .bits_per_mm = 5184,
                                      .reading_uncertainty = 1,
                                      .distance_uncertainty_mm = 0.05});
    ASSERT_TRUE(out);
    EXPECT_DOUBLE_EQ(out->per_mm.value, 1000);
    EXPECT_DOUBLE_EQ(out->scale.value, 5.184);
    EXPECT_NEAR(out->scale.uncertainty / out->scale.value, std::hypot(std::sqrt(2.0) / 50'000, 0.001), 1e-12);
    EXPECT_LT(calibrate_scale({.reading1 = 5, .reading2 = 1, .distance_mm = 1, .bits_per_mm = 1})->scale.value, 0);
    EXPECT_FALSE(calibrate_scale({.reading1 = 5, .reading2 = 5, .distance_mm = 1, .bits_per_mm = 1}));
    EXPECT_FALSE(calibrate_scale({.reading1 = 5, .reading2 = NAN, .distance_mm = 1, .bits_per_mm = 1}));
}

TEST(Calibration, CentreAndCountsATurnFromThreeMarks) {
    const auto track =
        parts::Conveyor::make({.rotary = true, .centre_mm = {-30, 12}, .profile = {{0, 10}}, .counts_per_unit = 1000});
    ASSERT_TRUE(track);
    std::array<RotaryMark, 3> marks;
    for (std::size_t i = 0; i < 3; ++i)
        marks[i] = {track->on_part({5, 5}, 4.0 * static_cast<double>(i)), 40'000.0 * static_cast<double>(i)};
    const auto out = calibrate_rotary(marks, 0.01);
    ASSERT_TRUE(out) << out.error().text();
    EXPECT_NEAR(out->centre_x.value, -30, 1e-9);
    EXPECT_NEAR(out->centre_y.value, 12, 1e-9);
    EXPECT_NEAR(out->counts_per_turn.value, 360'000, 1e-3) << "counter-clockwise is positive";
    EXPECT_LT(out->unlike, 1e-9);
    EXPECT_GT(out->centre_x.uncertainty, 0.005);
    EXPECT_LT(out->centre_x.uncertainty, 0.1);
    marks[2].at = {2 * marks[1].at.x - marks[0].at.x, 2 * marks[1].at.y - marks[0].at.y};
    EXPECT_FALSE(calibrate_rotary(marks, 0.01)) << "on a line";
}

TEST(Calibration, UncertaintiesAreThoseOfRepeatedTrials) {
    const auto track = *parts::Conveyor::make({.rotary = true, .centre_mm = {-30, 0}, .profile = {{0, 10}}});
    const double sigma = 0.02;
    double squares = 0, uncertainty = 0;
    constexpr int trials = 2000;
    unsigned state = 12345;
    const auto noise = [&] {  // the sum of twelve uniform numbers is nearly normal with sigma 1
        double sum = -6;
        for (int i = 0; i < 12; ++i) state = state * 1664525u + 1013904223u, sum += (state >> 8) / 16777216.0;
        return sum * sigma;
    };
    for (int t = 0; t < trials; ++t) {
        std::array<RotaryMark, 3> marks;
        for (std::size_t i = 0; i < 3; ++i) {
            const Spot at = track.on_part({5, 5}, 3.0 * static_cast<double>(i));
            marks[i] = {{at.x + noise(), at.y + noise()}, 30'000.0 * static_cast<double>(i)};
        }
        const auto out = *calibrate_rotary(marks, sigma, 0);
        squares += (out.centre_x.value + 30) * (out.centre_x.value + 30) / trials;
        uncertainty += out.centre_x.uncertainty / trials;
    }
    EXPECT_NEAR(std::sqrt(squares) / uncertainty, 1, 0.1);
}

TEST(Calibration, LagFromACrossMarkedAtTwoVelocitiesIsThatOfTheMirrors) {
    // Marks the vertical line of the cross on the simulated belt and returns its offset on the part, mm, against the
    // movement; the delay of the mirrors causes it.
    const auto shift = [](double velocity, int tracking_error_us) {
        JobRead read = read_job(
            "[drawing]\nsvg = 's'\nanchor = 'origin'\n[galvo]\nideal_mirrors = false\ndead_time_us = "
            "50\nnatural_frequency_hz = "
            "3183.1\ndamping_ratio = 1\nmax_velocity_bits_ms = 1e7\n"
            "[pace]\njump_delay_us = 2000\nmark_delay_us = 1000\nlaser_on_us = 500\n[belt]\ncounts_per_mm = "
            "20000\nvelocity_mm_s = " +
                std::to_string(velocity) +
                "\n[fly]\nmode = 'encoder'\ntracking_error_us = " + std::to_string(tracking_error_us) + "\n",
            "j");
        const Prepared prepared = *prepare(*read.job, [](const std::string&) -> Result<std::string> {
            return std::string("<svg><path d='M0 -5V5'/></svg>");
        });
        const MarkingOutcome out = *run_job(*read.job, prepared);
        const auto& points = out.on.points;
        return -points.at(points.size() / 2).at.x;
    };
    const auto out = calibrate_lag(
        {.velocity_mm_s = {100, 500}, .shift_mm = {shift(100, 0), shift(500, 0)}, .shift_uncertainty_mm = 0.002});
    ASSERT_TRUE(out) << out.error().text();
    EXPECT_NEAR(out->lag_us.value, 150, 6);
    EXPECT_EQ(out->tracking_error, 15);
    EXPECT_NEAR(out->lag_us.uncertainty, std::sqrt(2.0) * 0.002 / 400 * 1e6, 1e-9);
    EXPECT_LT(std::fabs(shift(500, 150)), 0.006) << "set, the cross is in its place";
    EXPECT_FALSE(calibrate_lag({.velocity_mm_s = {100, 100}, .shift_mm = {0, 1}}));
    EXPECT_FALSE(calibrate_lag({.velocity_mm_s = {100, 500}, .shift_mm = {0, -1}}));
}

}  // namespace
}  // namespace motionrack::mark
