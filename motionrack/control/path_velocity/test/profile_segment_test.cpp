// Duration of a cell and the motion on it, for cells of every curvature, also with standstill at an end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <random>

namespace motionrack::control {
namespace {

/// Expects that the motion advances from the beginning to the end in the duration of the cell, and never moves back.
void expect_motion_forward(const ProfileSegment& cell) {
    constexpr int samples = 50;
    double last = 0;
    for (int i = 1; i < samples; ++i) {
        const PathMotion at = cell.at(cell.seconds * i / samples);
        ASSERT_GT(at.u, last) << "velocity2 " << cell.velocity2 << " slope " << cell.velocity2_slope << " curvature "
                              << cell.velocity2_curvature << " length " << cell.length << " at " << i;
        last = at.u;
    }
    // The relative error of the duration is up to 1e-10; the peak velocity converts it to an error of the position.
    const double x = std::clamp(-cell.velocity2_slope / cell.velocity2_curvature, 0.0, cell.length);
    const double peak = std::sqrt(
        std::max(cell.velocity2 + x * (cell.velocity2_slope + 0.5 * cell.velocity2_curvature * x), cell.velocity2));
    ASSERT_NEAR(cell.at(cell.seconds).u, cell.length, 1e-9 * std::max(cell.length, peak * cell.seconds));
}

/// velocity2 falls to about 1/50 at a phase of 1.42 rad of a harmonic oscillation. The oscillation reaches the same
/// position again after a whole period; the duration must be that of the first passage.
TEST(ProfileSegment, EndsInTheFirstQuarterOfAnOscillationThatStartsAtItsPeakVelocity) {
    const ProfileSegment cell = parabolic_segment(0, 4.69668748e-12, 3.99782223e-16, 0, -35469344.8);
    EXPECT_LT(cell.seconds, 0.5 * pi / std::sqrt(0.5 * 35469344.8));
    expect_motion_forward(cell);
}

/// velocity2 is a parabola, above 0 between its two zeros; the cell is a random part of the interval between them.
TEST(ProfileSegment, AdvancesFromBeginToEndWhereTheVelocityRisesAndFalls) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    for (int i = 0; i < 2'000; ++i) {
        const double half = std::pow(10.0, -9 + 10 * part(random)), bend = std::pow(10.0, -2 + 10 * part(random));
        double from = -1 + 2 * part(random), to = -1 + 2 * part(random);
        if (i % 4 == 0) from = -1 + 1e-9 * part(random);
        if (i % 4 == 1) to = 1 - 1e-9 * part(random);
        if (from > to) std::swap(from, to);
        if (to - from < 1e-3) continue;
        const double square = 0.5 * bend * half * half * (1 - from * from);
        const ProfileSegment cell = parabolic_segment(0, half * (to - from), square, -bend * half * from, -bend);
        ASSERT_NEAR(cell.seconds, (std::asin(to) - std::asin(from)) / std::sqrt(0.5 * bend), 1e-6 * cell.seconds)
            << from << " to " << to << " of " << half << " bend " << bend;
        expect_motion_forward(cell);
    }
}

/// Half a period after its beginning, the oscillation passes the end a second time, on its way back; the cell must end
/// at the first passage.
TEST(ProfileSegment, EndsWhenItFirstReachesAnEndOfTheSameVelocity) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    for (int i = 0; i < 2'000; ++i) {
        const double half = std::pow(10.0, -9 + 10 * part(random)), bend = std::pow(10.0, -2 + 10 * part(random));
        const double to = 0.75 + 0.249 * part(random);
        const ProfileSegment cell =
            parabolic_segment(0, 2 * half * to, 0.5 * bend * half * half * (1 - to * to), bend * half * to, -bend);
        ASSERT_NEAR(cell.seconds, 2 * std::asin(to) / std::sqrt(0.5 * bend), 1e-6 * cell.seconds)
            << to << " of " << half << " bend " << bend;
        expect_motion_forward(cell);
    }
}

/// With a rounded slope, the computed velocity may reach 0 slightly before the end; the cell must still end there.
TEST(ProfileSegment, EndsAtStandstillWhereTheVelocityAtTheEndIsRoundedToZero) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    for (int i = 0; i < 2'000; ++i) {
        const double length = std::pow(10.0, -9 + 10 * part(random)), square = std::pow(10.0, -12 + 15 * part(random));
        const double slope = -square / length * (1 + 1e-16 * (i % 7));
        const ProfileSegment cell = parabolic_segment(0, length, square, slope, 0);
        ASSERT_NEAR(cell.seconds, 2 * length / std::sqrt(square), 1e-6 * cell.seconds)
            << length << " from " << square << " slope " << slope;
    }
}

}  // namespace
}  // namespace motionrack::control
