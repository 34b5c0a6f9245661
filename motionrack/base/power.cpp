// Numbers as sums of two doubles: whole powers by squaring, others by a logarithm of about 100 bits.
#include <cmath>
#include <limits>
#include <motionrack/base/exponential.hpp>
#include <motionrack/base/power.hpp>

namespace motionrack {

namespace {

constexpr double max_squared = 1e6;
constexpr double root_half_of_power = 0x1.6a09e667f3bcdp-1;

/// high + low, with low below half an ulp of high.
struct Pair {
    double high;
    double low;
};

constexpr Pair ln2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

Pair sum(double a, double b) {
    const double high = a + b, b_seen = high - a;
    return {high, (a - (high - b_seen)) + (b - b_seen)};
}

/// a b exactly, by halves of 26 bits.
Pair product(double a, double b) {
    constexpr double halver = 0x1p27 + 1;
    const double high = a * b, a_scaled = a * halver, b_scaled = b * halver;
    const double a1 = a_scaled - (a_scaled - a), b1 = b_scaled - (b_scaled - b), a2 = a - a1, b2 = b - b1;
    return {high, ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2};
}

Pair operator+(Pair a, Pair b) {
    const Pair s = sum(a.high, b.high);
    return sum(s.high, s.low + (a.low + b.low));
}

Pair operator*(Pair a, Pair b) {
    const Pair p = product(a.high, b.high);
    return sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

Pair operator/(Pair a, Pair b) {
    const double first = a.high / b.high;
    const Pair back = product(first, b.high);
    const double rest = ((a.high - back.high) - back.low) + a.low - first * b.low;
    return sum(first, rest / b.high);
}

/// 2^scale times a pair near 1, without overflow of an intermediate result.
double whole_power(double x, double y) {
    int exponent = 0;
    Pair base = {std::frexp(x, &exponent), 0};
    Pair result = {1, 0};
    double scale = 0, base_scale = exponent;
    for (auto left = static_cast<unsigned>(std::fabs(y)); left != 0; left >>= 1) {
        const auto normal = [](Pair& p, double& s) {
            int shift = 0;
            (void)std::frexp(p.high, &shift);
            p = {std::ldexp(p.high, -shift), std::ldexp(p.low, -shift)};
            s += shift;
        };
        if ((left & 1) != 0) {
            result = result * base;
            scale += base_scale;
            normal(result, scale);
        }
        base = base * base;
        base_scale *= 2;
        normal(base, base_scale);
    }
    if (y < 0) {
        result = Pair{1, 0} / result;
        scale = -scale;
    }
    if (std::fabs(scale) > 4000) scale = std::copysign(4000, scale);
    return std::ldexp(result.high + result.low, static_cast<int>(scale));
}

/// ln x = k ln 2 + 2 atanh((m - 1) / (m + 1)).
Pair logarithm(double x) {
    int exponent = 0;
    double m = std::frexp(x, &exponent);
    if (m < root_half_of_power) m *= 2, --exponent;
    const Pair s = Pair{m - 1, 0} / sum(m, 1), square = s * s;
    Pair series = {0, 0};
    for (int n = 43; n >= 3; n -= 2) series = (series + Pair{1, 0} / Pair{static_cast<double>(n), 0}) * square;
    const Pair twice = {2 * s.high, 2 * s.low};
    return Pair{static_cast<double>(exponent), 0} * ln2 + (twice + twice * series);
}

}  // namespace

double power(double x, double y) {
    if (y == 0) return 1;
    if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
    const bool whole = y == std::floor(y);
    if (x == 0) return y > 0 ? 0.0 : std::numeric_limits<double>::infinity();
    if (std::isinf(x) || std::isinf(y) || (x < 0 && !whole)) {
        if (x < 0 || std::isnan(x * y)) return std::numeric_limits<double>::quiet_NaN();
        const bool grows = (x > 1) == (y > 0);
        return x == 1 ? 1 : grows ? std::numeric_limits<double>::infinity() : 0;
    }
    if (whole && std::fabs(y) <= max_squared) return whole_power(x, y);
    const Pair exponent = logarithm(std::fabs(x)) * Pair{y, 0};
    const double size = exponential(exponent.high);
    const bool odd = whole && std::fmod(y, 2) != 0;
    const double result = std::isfinite(size) ? size + size * exponent.low : size;
    return x < 0 && odd ? -result : result;
}

}  // namespace motionrack
