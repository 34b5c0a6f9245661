// Pseudo-random bits that are the same on every machine, as a stateless function from number to number.
#pragma once

#include <cstdint>

namespace motionrack {

/// Mixes all bits of `x` (the last step of SplitMix64); one to one, 0 gives 0.
constexpr std::uint64_t mixed_bits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

/// The odd increment of SplitMix64: 2^64 divided by the golden ratio.
inline constexpr std::uint64_t golden_step = 0x9E3779B97F4A7C15ull;
static_assert(mixed_bits(golden_step) == 0xE220A8397B1DCDAFull, "SplitMix64's first number after 0");

}  // namespace motionrack
