// The range that a count has not left.
#pragma once

#include <algorithm>
#include <cstdint>
#include <motionrack/sim/motion.hpp>

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

}  // namespace motionrack::sim
