// The range that a count has not left, and the interval that it comes into.
#pragma once

#include <algorithm>
#include <cstdint>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::sim {

/// What is watched: left as soon as count <= below or count >= above, as Motion::watch has it.
struct Range {
    std::int64_t below = unwatched_below;
    std::int64_t above = unwatched_above;

    constexpr bool left(std::int64_t count) const {
        return (count <= below && below != unwatched_below) || (count >= above && above != unwatched_above);
    }
    /// What lies in both.
    constexpr Range within(const Range& other) const {
        return {std::max(below, other.below), std::min(above, other.above)};
    }
    /// The range of count + offset; open ends stay open.
    constexpr Range moved(std::int64_t offset) const {
        return {below == unwatched_below ? below : below + offset, above == unwatched_above ? above : above + offset};
    }
    friend constexpr bool operator==(const Range&, const Range&) = default;
};

/// Places in a row, both ends included: a cam, a block.
struct Interval {
    std::int64_t from = 0;
    std::int64_t to = 0;

    constexpr bool has(std::int64_t count) const { return count >= from && count <= to; }
    /// The range around `count` in which it stays in the interval, before it or behind it.
    constexpr Range side_of(std::int64_t count) const {
        if (count < from) return {unwatched_below, from};
        if (count > to) return {to, unwatched_above};
        return {from - 1, to + 1};
    }
};

}  // namespace motionrack::sim
