// Whole-number helpers of the parts: division towards minus infinity and the range that a position has not left.
#pragma once

#include <algorithm>
#include <cstdint>
#include <motionrack/sim/motion.hpp>

namespace motionrack::parts {

__extension__ using Wide = __int128;

/// The greatest whole number not above a / b (b > 0).
constexpr std::int64_t floor_div(Wide a, std::int64_t b) {
    const Wide q = a / b;
    return static_cast<std::int64_t>(a % b < 0 ? q - 1 : q);
}

/// The least whole number not below a / b (b > 0).
constexpr std::int64_t ceil_div(Wide a, std::int64_t b) {
    return -floor_div(-a, b);
}

/// a modulo b in 0 .. b-1 (b > 0).
constexpr std::int64_t floor_mod(std::int64_t a, std::int64_t b) {
    const std::int64_t m = a % b;
    return m < 0 ? m + b : m;
}

/// What is watched: left as soon as count <= below or count >= above, as Motion::watch has it.
struct Range {
    std::int64_t below = sim::unwatched_below;
    std::int64_t above = sim::unwatched_above;

    constexpr bool left(std::int64_t count) const {
        return (count <= below && below != sim::unwatched_below) || (count >= above && above != sim::unwatched_above);
    }
    /// What lies in both.
    constexpr Range within(const Range& other) const {
        return {std::max(below, other.below), std::min(above, other.above)};
    }
    /// The range of count + offset; open ends stay open.
    constexpr Range moved(std::int64_t offset) const {
        return {below == sim::unwatched_below ? below : below + offset,
                above == sim::unwatched_above ? above : above + offset};
    }
    friend constexpr bool operator==(const Range&, const Range&) = default;
};

}  // namespace motionrack::parts
