// Taylor polynomials after an exact reduction of the argument; ln 2 is split in two doubles.
#include <cmath>
#include <limits>
#include <motionrack/base/exponential.hpp>

namespace motionrack {

namespace {

constexpr double ln2_high = 0x1.62e42fefap-1;  // 36 bits: its product with an exponent is exact
constexpr double ln2_low = 0x1.cf79abc9e3b39p-40;
constexpr double sqrt_half = 0x1.6a09e667f3bcdp-1;

}  // namespace

double exponential(double x) {
    if (!(x >= -700)) return x != x ? x : 0.0;
    if (x > 700) return std::numeric_limits<double>::infinity();
    const double k = std::floor(x / 0x1.62e42fefa39efp-1 + 0.5);
    const double high = x - k * ln2_high, low = k * ln2_low;
    const double r = high - low;  // |r| <= 0.35
    double sum = 0;
    for (int n = 13; n >= 2; --n) sum = (sum + 1) * r / n;
    // e^r = 1 + r (1 + sum); the rounding error of the subtraction is added first, as it is the smallest term.
    const double rest = (high - r) - low;
    return std::ldexp(1 + (r + (r * sum + rest)), static_cast<int>(k));
}

double natural_log(double x) {
    if (!(x > 0)) return x == 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    if (x > std::numeric_limits<double>::max()) return x;
    int exponent = 0;
    double m = std::frexp(x, &exponent);  // 0.5 .. 1
    if (m < sqrt_half) m *= 2, --exponent;
    // ln m = 2 atanh s
    const double s = (m - 1) / (m + 1), square = s * s;
    double sum = 0;
    for (int n = 21; n >= 3; n -= 2) sum = (sum + 1.0 / n) * square;
    const double k = exponent;
    return k * ln2_high + (2 * s + (2 * s * sum + k * ln2_low));
}

}  // namespace motionrack
