// Random whole numbers, the same on every machine.
#pragma once

#include <cstdint>
#include <random>

namespace motionrack::rack {

using Random = std::mt19937_64;

/// Draws from `min` to `max`, both included.
inline std::int64_t drawn(Random& random, std::int64_t min, std::int64_t max) {
    return min + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(max - min + 1));
}

}  // namespace motionrack::rack
