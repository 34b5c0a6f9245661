// Trigonometry by Taylor polynomials after an exact reduction of the argument; constants are divided into two or three
// doubles.

#include <cmath>
#include <cstdint>
#include <limits>
#include <motionrack/base/trig.hpp>

namespace motionrack {
namespace {

// pi/2 in three parts; the first two have 33 bits, so their products with a quadrant below 2^20 are exact.
constexpr double half_pi_1 = 0x1.921fb544p+0;
constexpr double half_pi_2 = 0x1.0b4611a6p-34;
constexpr double half_pi_3 = 0x1.3198a2e037073p-69;
constexpr double two_over_pi = 0x1.45f306dc9c883p-1;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double largest_angle = 1e9;

/// A number as a sum of a double and a small remainder.
struct Split {
    double high;
    double low;
};

/// angle - quadrant * pi/2, to about 2^-100.
Split reduce(double angle, double quadrant) {
    const double a = angle - quadrant * half_pi_1;
    const double b = quadrant * half_pi_2;
    const double r = a - b;
    const double b_seen = a - r;
    const double rest = (a - (r + b_seen)) + (b_seen - b) - quadrant * half_pi_3;
    const double high = r + rest;
    return {high, (r - high) + rest};
}

constexpr double inverse_factorial(int n) {
    double f = 1;
    for (int i = 2; i <= n; ++i) f *= i;
    return 1 / f;
}

template <int n>
inline constexpr double over_fact = inverse_factorial(n);

/// sin on [-pi/4, pi/4]; the series is cut below 2^-63 of the value.
double sin_core(Split x) {
    const double z = x.high * x.high;
    const double w = z * z;
    const double even = -over_fact<3> + w * (-over_fact<7> + w * (-over_fact<11> - w * over_fact<15>));
    const double odd = over_fact<5> + w * (over_fact<9> + w * (over_fact<13> + w * over_fact<17>));
    return x.high + (x.high * z * (even + z * odd) + x.low * (1 - 0.5 * z));
}

/// cos on [-pi/4, pi/4].
double cos_core(Split x) {
    const double z = x.high * x.high;
    const double w = z * z;
    const double even = over_fact<4> + w * (over_fact<8> + w * (over_fact<12> + w * over_fact<16>));
    const double odd = -over_fact<6> + w * (-over_fact<10> + w * (-over_fact<14> - w * over_fact<18>));
    const double half = 0.5 * z;
    const double head = 1 - half;
    return head + (((1 - head) - half) + (w * (even + z * odd) - x.high * x.low));
}

/// An eighth k/8 as a sum of two powers of two (or zero), so y - k/8 x is exact, and its arc tangent.
struct Eighth {
    double first;
    double second;
    Split angle;
};

constexpr Eighth eighths[9] = {
    {0, 0, {0, 0}},
    {0.125, 0, {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59}},
    {0.25, 0, {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57}},
    {0.25, 0.125, {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56}},
    {0.5, 0, {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56}},
    {0.5, 0.125, {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58}},
    {0.5, 0.25, {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56}},
    {1, -0.125, {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56}},
    {1, 0, {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}},
};

constexpr Split pi_split = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Split half_pi_split = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// a - b for a.high >= b.high, or b.high = 0.
Split subtract(Split a, Split b) {
    const double high = a.high - b.high;
    return {high, ((a.high - high) - b.high) + (a.low - b.low)};
}

/// atan of y/x for 0 <= y <= x, x > 0, both far from overflow and underflow.
Split atan_first_octant(double y, double x) {
    const double ratio = y / x;
    const Eighth& near = eighths[static_cast<int>(ratio * 8 + 0.5)];
    const double eighth = near.first + near.second;
    // |t| <= 1/16
    const double t = eighth == 0 ? ratio : ((y - near.first * x) - near.second * x) / (x + eighth * y);
    const double z = t * t;
    const double w = z * z;
    const double even = -1.0 / 3 + w * (-1.0 / 7 + w * (-1.0 / 11 - w * (1.0 / 15)));
    const double odd = 1.0 / 5 + w * (1.0 / 9 + w * (1.0 / 13));
    const double rest = t * z * (even + z * odd) + near.angle.low;
    const double high = near.angle.high + t;
    return {high, ((near.angle.high - high) + t) + rest};
}

}  // namespace

SinCos sin_cos(double radians) {
    if (!(std::fabs(radians) <= largest_angle)) return {nan_value, nan_value};
    if (radians == 0) return {radians, 1};  // keeps the sign of zero
    const auto quadrant = static_cast<std::int64_t>(radians * two_over_pi + (radians < 0 ? -0.5 : 0.5));
    const Split x = quadrant == 0 ? Split{radians, 0} : reduce(radians, static_cast<double>(quadrant));
    const double s = sin_core(x);
    const double c = cos_core(x);
    switch (quadrant & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

double atan2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) return nan_value;
    double width = std::fabs(x);
    double height = std::fabs(y);
    if (std::isinf(width) || std::isinf(height)) {
        width = std::isinf(width) ? 1 : 0;
        height = std::isinf(height) ? 1 : 0;
    }
    const bool steep = height > width;
    double large = steep ? height : width;
    double small = steep ? width : height;
    if (large > 1e300 || (large < 1e-290 && large > 0)) {
        const double scale = large > 1e300 ? 0x1p-100 : 0x1p+100;
        large *= scale;
        small *= scale;
    }
    Split angle = large == 0 ? Split{0, 0} : atan_first_octant(small, large);
    if (steep) angle = subtract(half_pi_split, angle);
    if (std::signbit(x)) angle = subtract(pi_split, angle);
    return std::copysign(angle.high + angle.low, y);
}

double acos(double x) {
    return 2 * atan2(std::sqrt(1 - x), std::sqrt(1 + x));
}

double asin(double x) {
    return atan2(x, std::sqrt((1 - x) * (1 + x)));
}

double tan(double radians) {
    const SinCos both = sin_cos(radians);
    return both.sin / both.cos;
}

}  // namespace motionrack
