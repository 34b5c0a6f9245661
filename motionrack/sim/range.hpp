// Watched range of a count, and interval of counts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <motionrack/sim/position_function.hpp>

namespace motionrack::sim {

/// A watched range: left as soon as count <= below or count >= above, as in PositionFunction::watch.
struct Range {
    std::int64_t below = unwatched_below;
    std::int64_t above = unwatched_above;

    constexpr bool left(std::int64_t count) const {
        return (count <= below && below != unwatched_below) || (count >= above && above != unwatched_above);
    }
    /// Returns the intersection of both ranges.
    constexpr Range within(const Range& other) const {
        return {std::max(below, other.below), std::min(above, other.above)};
    }
    /// Returns the range moved by `offset` counts; open ends stay open.
    constexpr Range moved(std::int64_t offset) const {
        return {below == unwatched_below ? below : below + offset, above == unwatched_above ? above : above + offset};
    }
    friend constexpr bool operator==(const Range&, const Range&) = default;
};

/// Consecutive positions, both ends included: a cam, a block.
struct Interval {
    std::int64_t from = 0;
    std::int64_t to = 0;

    constexpr bool has(std::int64_t count) const { return count >= from && count <= to; }
    /// Range around `count` in which it stays within, before or behind the interval.
    constexpr Range side_of(std::int64_t count) const {
        if (count < from) return {unwatched_below, from};
        if (count > to) return {to, unwatched_above};
        return {from - 1, to + 1};
    }
};

}  // namespace motionrack::sim
