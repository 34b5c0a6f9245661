// The project's trigonometry against long double (64-bit mantissa on x86) and against exact angles.

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <motionrack/base/trig.hpp>
#include <random>

namespace motionrack {
namespace {

constexpr std::uint32_t seed = 20240611;
constexpr int angles = 400'000;

/// Distance of `value` from `truth` in units of the last place of `value`'s binade.
double ulps(double value, long double truth) {
    if (static_cast<long double>(value) == truth) return 0;
    const double near = std::fabs(static_cast<double>(truth));
    const double ulp = std::nextafter(near, std::numeric_limits<double>::infinity()) - near;
    return std::fabs(static_cast<double>((static_cast<long double>(value) - truth) / static_cast<long double>(ulp)));
}

bool wide_long_double() {
    return std::numeric_limits<long double>::digits >= 64;
}

double worst_sin_cos(double range, std::mt19937_64& random) {
    std::uniform_real_distribution<double> angle(-range, range);
    double max_error = 0;
    for (int i = 0; i < angles; ++i) {
        const double x = angle(random);
        const SinCos got = sin_cos(x);
        max_error = std::fmax(max_error, ulps(got.sin, std::sin(static_cast<long double>(x))));
        max_error = std::fmax(max_error, ulps(got.cos, std::cos(static_cast<long double>(x))));
    }
    return max_error;
}

TEST(Trig, SineAndCosineAreWithinAnUlpUpToAMillionRadians) {
    if (!wide_long_double()) GTEST_SKIP() << "long double is no wider than double here";
    std::mt19937_64 random(seed);
    for (const double range : {1e-3, 0.7854, 7.0, 1e3, 1e6}) {
        const double max_error = worst_sin_cos(range, random);
        RecordProperty("worst_ulps_sin_cos", std::to_string(max_error));
        EXPECT_LT(max_error, 0.85) << "range " << range << ", seed " << seed;
    }
}

TEST(Trig, SineAndCosineStayExactNextToMultiplesOfAQuarterTurn) {
    if (!wide_long_double()) GTEST_SKIP() << "long double is no wider than double here";
    // pi/2 to 2^-118: a reference independent of the C library's own reduction.
    const long double high = 1.57079632679489661923132169163975144L;
    for (int k = 1; k <= 600'000; k += k < 1000 ? 1 : 997) {
        const double x = static_cast<double>(high * k);
        const SinCos got = sin_cos(x);
        EXPECT_LT(ulps(got.sin, std::sin(static_cast<long double>(x))), 0.85) << "k " << k;
        EXPECT_LT(ulps(got.cos, std::cos(static_cast<long double>(x))), 0.85) << "k " << k;
    }
}

TEST(Trig, SpecialAnglesHaveExactValues) {
    EXPECT_EQ(sin_cos(0).sin, 0);
    EXPECT_EQ(sin_cos(0).cos, 1);
    EXPECT_TRUE(std::signbit(sin_cos(-0.0).sin));
    EXPECT_EQ(sin_cos(pi / 2).sin, 1);
    EXPECT_EQ(sin_cos(pi).cos, -1);
    EXPECT_EQ(sin_cos(-pi / 2).sin, -1);
    EXPECT_DOUBLE_EQ(sin_cos(pi / 6).sin, 0.5);
    EXPECT_DOUBLE_EQ(sin_cos(pi / 3).cos, 0.5);
    EXPECT_DOUBLE_EQ(sin_cos(pi / 4).sin, std::sqrt(0.5));
    EXPECT_EQ(sin_cos(1e-300).sin, 1e-300);
    // the double next to pi is 1.2246467991473532e-16 below pi
    EXPECT_DOUBLE_EQ(sin_cos(pi).sin, 1.2246467991473532e-16);
}

TEST(Trig, AnglesThatAreTooLargeOrNotNumbersGiveNaN) {
    const double inf = std::numeric_limits<double>::infinity();
    for (const double x : {inf, -inf, std::nan(""), 1.1e9, -1e300}) {
        EXPECT_TRUE(std::isnan(sin_cos(x).sin)) << x;
        EXPECT_TRUE(std::isnan(sin_cos(x).cos)) << x;
    }
}

TEST(Trig, ArcTangentIsWithinItsErrorBound) {
    if (!wide_long_double()) GTEST_SKIP() << "long double is no wider than double here";
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    std::uniform_int_distribution<int> power(-30, 30);
    double max_error = 0;
    for (int i = 0; i < angles; ++i) {
        const double y = std::ldexp(any(random), i % 2 == 0 ? 0 : power(random));
        const double x = any(random);
        const double got = motionrack::atan2(y, x);
        max_error =
            std::fmax(max_error, ulps(got, std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
    }
    RecordProperty("worst_ulps_atan2", std::to_string(max_error));
    EXPECT_LT(max_error, 1.2) << "seed " << seed;
}

TEST(Trig, ArcTangentOfAxesZerosAndInfinitiesEqualsThatOfC) {
    const double inf = std::numeric_limits<double>::infinity();
    const double values[] = {0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324, 1e-310, 1e308, -1e308, inf, -inf};
    for (const double y : values) {
        for (const double x : values) {
            const double got = motionrack::atan2(y, x);
            EXPECT_DOUBLE_EQ(got, std::atan2(y, x)) << y << ' ' << x;
            EXPECT_EQ(std::signbit(got), std::signbit(y)) << y << ' ' << x;
        }
    }
    EXPECT_TRUE(std::isnan(motionrack::atan2(std::nan(""), 1)));
    EXPECT_TRUE(std::isnan(motionrack::atan2(1, std::nan(""))));
    EXPECT_EQ(motionrack::atan2(1, 1), pi / 4);
    EXPECT_EQ(motionrack::atan2(0, -1), pi);
}

TEST(Trig, ArcCosineIsWithinTwoAndAHalfUlps) {
    if (!wide_long_double()) GTEST_SKIP() << "long double is no wider than double here";
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    double max_error = 0;
    for (int i = 0; i < angles; ++i) {
        const double x = i % 4 == 0 ? 1 - std::ldexp(any(random), -30) * any(random) : any(random);
        if (std::fabs(x) > 1) continue;
        max_error = std::fmax(max_error, ulps(motionrack::acos(x), std::acos(static_cast<long double>(x))));
    }
    RecordProperty("worst_ulps_acos", std::to_string(max_error));
    EXPECT_LT(max_error, 2.6) << "seed " << seed;
    EXPECT_EQ(motionrack::acos(1), 0);
    EXPECT_EQ(motionrack::acos(-1), pi);
    EXPECT_TRUE(std::isnan(motionrack::acos(1.0000001)));
}

/// Folds the bits of many results; the number below was the same with g++ and clang++ at -O0, -O2 and -O3.
TEST(Trig, BitsAreTheSameOnEveryCompilerAndCpu) {
    std::uint64_t state = seed;
    std::uint64_t fold = 0;
    const auto mix = [&fold](double value) {
        fold = (fold ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15u;
    };
    for (int i = 0; i < 100'000; ++i) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const double x = static_cast<double>(static_cast<std::int64_t>(state) >> 11) * 0x1p-32;
        const SinCos got = sin_cos(x);
        mix(got.sin);
        mix(got.cos);
        mix(motionrack::atan2(got.sin, x));
        mix(motionrack::acos(got.cos));
    }
    EXPECT_EQ(fold, 6524200274331499511u);
}

}  // namespace
}  // namespace motionrack
