// Integer helpers of the parts: division towards minus infinity, and the range that a position has not left.
#pragma once

#include <cstdint>
#include <motionrack/sim/range.hpp>

namespace motionrack::parts {

using sim::Range;
__extension__ using Wide = __int128;

/// Returns the largest whole number not above a / b (b > 0).
constexpr std::int64_t floor_div(Wide a, std::int64_t b) {
    const Wide q = a / b;
    return static_cast<std::int64_t>(a % b < 0 ? q - 1 : q);
}

/// Returns the smallest whole number not below a / b (b > 0).
constexpr std::int64_t ceil_div(Wide a, std::int64_t b) {
    return -floor_div(-a, b);
}

/// Returns a modulo b, in 0 .. b - 1 (b > 0).
constexpr std::int64_t floor_mod(std::int64_t a, std::int64_t b) {
    const std::int64_t m = a % b;
    return m < 0 ? m + b : m;
}

}  // namespace motionrack::parts
