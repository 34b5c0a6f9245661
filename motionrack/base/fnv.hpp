// FNV-1a, the hash of Fowler, Noll and Vo: short, and the same on every machine. It is not cryptographic.
#pragma once

#include <cstdint>
#include <string_view>

namespace motionrack {

inline constexpr std::uint64_t fnv_start = 0xCBF29CE484222325ull;

/// Adds one more value to the hash; the original adds bytes.
constexpr std::uint64_t fnv_step(std::uint64_t hash, std::uint64_t value) {
    return (hash ^ value) * 0x100000001B3ull;
}

constexpr std::uint64_t fnv_of(std::string_view text) {
    std::uint64_t hash = fnv_start;
    for (const char c : text) hash = fnv_step(hash, static_cast<unsigned char>(c));
    return hash;
}
static_assert(fnv_of("a") == 0xAF63DC4C8601EC8Cull, "the published value");

}  // namespace motionrack
