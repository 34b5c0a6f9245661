// Numbers that a user passes to the tests: MOTIONRACK_SEED=7 test_mcx314.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace motionrack {

/// Returns the integer in an environment variable; `otherwise` if it is not set or empty.
inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text != nullptr && *text != '\0' ? std::strtoull(text, nullptr, 0) : otherwise;
}

/// Returns true if tests may take long (MOTIONRACK_THOROUGH=1), as in the part `seeds` of ./test --all.
inline bool thorough() {
    return from_environment("MOTIONRACK_THOROUGH", 0) != 0;
}

/// Returns the number of attempts of a test: the environment variable; by default `everyday`, or `all` if thorough().
inline std::uint64_t trials(const char* name, std::uint64_t everyday, std::uint64_t all) {
    return from_environment(name, thorough() ? all : everyday);
}

/// Returns the number of random programs, jobs or accesses of a test: the environment variable; by default
/// MOTIONRACK_CASES_PERCENT of the everyday number, at least 1. Builds with slow checks use a share.
inline std::uint64_t cases(const char* name, std::uint64_t everyday) {
    const std::uint64_t part = everyday * from_environment("MOTIONRACK_CASES_PERCENT", 100) / 100;
    return from_environment(name, part > 0 ? part : 1);
}

/// Returns the first seed of random tests: MOTIONRACK_SEED, or the same number in every run.
inline std::uint64_t seed_from_environment(std::uint64_t otherwise = 1) {
    return from_environment("MOTIONRACK_SEED", otherwise);
}

/// Returns `count` of the numbers 0 .. all - 1, or all of them: at equal distances, from MOTIONRACK_SEED on (without it
/// from 0), so that many seeds try each number.
inline std::vector<std::int64_t> spread_by_seed(std::int64_t all, std::uint64_t count) {
    const std::int64_t chosen = std::min(all, static_cast<std::int64_t>(count));
    const std::uint64_t seed = seed_from_environment(0);
    std::vector<std::int64_t> out;
    for (std::int64_t i = 0; i < chosen; ++i)
        out.push_back((i * all / chosen + static_cast<std::int64_t>(seed % static_cast<std::uint64_t>(all))) % all);
    return out;
}

}  // namespace motionrack
