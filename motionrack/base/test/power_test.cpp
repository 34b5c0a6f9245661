// Accuracy of powers, tangent and arc sine.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <motionrack/base/power.hpp>
#include <motionrack/base/trig.hpp>
#include <random>

namespace motionrack {
namespace {

constexpr std::uint64_t power_seed = 20240607;

bool has_wide_long_double() {
    return std::numeric_limits<long double>::digits > std::numeric_limits<double>::digits;
}

double ulps_of_power(double got, long double wanted) {
    const double near = static_cast<double>(wanted);
    const double ulp = std::nextafter(std::fabs(near), std::numeric_limits<double>::infinity()) - std::fabs(near);
    return static_cast<double>(std::fabs(static_cast<long double>(got) - wanted) / static_cast<long double>(ulp));
}

TEST(Power, IsWithinItsErrors) {
    if (!has_wide_long_double()) GTEST_SKIP() << "long double is no wider than double here";
    std::mt19937_64 random(power_seed);
    std::uniform_real_distribution<double> size(-30, 30), exponent(-9, 9);
    double max_error = 0, worst_whole = 0;
    for (int i = 0; i < 100'000; ++i) {
        const double x = std::exp2(size(random)), y = exponent(random),
                     whole = std::round(exponent(random) * (i % 2 ? 1 : 5));
        max_error = std::fmax(
            max_error, ulps_of_power(power(x, y), std::pow(static_cast<long double>(x), static_cast<long double>(y))));
        const double at = i % 3 ? x : -x;
        if (std::fabs(std::log2(x) * whole) > 990) continue;
        // Whole powers of long double lose half an ulp with each product; they are accurate to 2^-60 here.
        worst_whole = std::fmax(
            worst_whole,
            ulps_of_power(power(at, whole), std::pow(static_cast<long double>(at), static_cast<long double>(whole))));
    }
    RecordProperty("worst_ulps", std::to_string(max_error));
    RecordProperty("worst_ulps_whole", std::to_string(worst_whole));
    EXPECT_LT(max_error, 1.6) << "seed " << power_seed;
    EXPECT_LT(worst_whole, 0.55) << "seed " << power_seed;
}

TEST(Power, IsExactWhereTheResultIs) {
    EXPECT_EQ(power(2, 10), 1024);
    EXPECT_EQ(power(-3, 5), -243);
    EXPECT_EQ(power(-3, 4), 81);
    EXPECT_EQ(power(10, 15), 1e15);
    EXPECT_EQ(power(2, -2), 0.25);
    EXPECT_EQ(power(2, 1000), 0x1p1000);
    EXPECT_EQ(power(2, -1000), 0x1p-1000);
    EXPECT_EQ(power(1, 1e300), 1);
    EXPECT_EQ(power(7, 0), 1);
    EXPECT_EQ(power(0, 3), 0);
}

TEST(Power, ReportsArgumentsWithoutAResult) {
    EXPECT_TRUE(std::isnan(power(-8, 1.0 / 3)));
    EXPECT_TRUE(std::isnan(power(std::nan(""), 2)));
    EXPECT_TRUE(std::isinf(power(0, -1)));
    EXPECT_TRUE(std::isinf(power(10, 400)));
    EXPECT_EQ(power(10, -400), 0);
    EXPECT_TRUE(std::isinf(power(1.5, 1e300)));
    EXPECT_EQ(power(1.5, -1e300), 0);
}

TEST(Trig, TangentAndArcSineAreWithinTheirErrors) {
    if (!has_wide_long_double()) GTEST_SKIP() << "long double is no wider than double here";
    std::mt19937_64 random(power_seed);
    std::uniform_real_distribution<double> angle(-1000, 1000), any(-1, 1);
    double worst_tan = 0, worst_asin = 0;
    for (int i = 0; i < 200'000; ++i) {
        const double a = angle(random), x = any(random);
        worst_tan = std::fmax(worst_tan, ulps_of_power(motionrack::tan(a), std::tan(static_cast<long double>(a))));
        worst_asin = std::fmax(worst_asin, ulps_of_power(motionrack::asin(x), std::asin(static_cast<long double>(x))));
    }
    RecordProperty("worst_ulps_tan", std::to_string(worst_tan));
    RecordProperty("worst_ulps_asin", std::to_string(worst_asin));
    EXPECT_LT(worst_tan, 2.5) << "seed " << power_seed;
    EXPECT_LT(worst_asin, 2.6) << "seed " << power_seed;
    EXPECT_EQ(motionrack::asin(0), 0);
    EXPECT_EQ(motionrack::asin(1), pi / 2);
    EXPECT_TRUE(std::isnan(motionrack::asin(-1.5)));
}

/// Folds the bits of many results; the number below was the same with g++ and clang++ at -O0, -O2 and -O3.
TEST(Power, BitsAreTheSameOnEveryCompilerAndCpu) {
    std::uint64_t state = power_seed, fold = 0;
    const auto mix = [&fold](double value) {
        fold = (fold ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u;
    };
    for (int i = 0; i < 50'000; ++i) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const double x = static_cast<double>(state >> 11) * 0x1p-40,
                     y = static_cast<double>(static_cast<std::int64_t>(state << 7) >> 20) * 0x1p-40;
        mix(power(x, y));
        mix(power(x, static_cast<double>(i % 40 - 20)));
        mix(motionrack::tan(y));
        mix(motionrack::asin(y / 16));
    }
    EXPECT_EQ(fold, 7061450484189980797u);
}

}  // namespace
}  // namespace motionrack
