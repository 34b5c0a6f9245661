// Numbers that a user of the tests hands over: MOTIONRACK_SEED=7 test_mcx314.
#pragma once

#include <cstdint>
#include <cstdlib>

namespace motionrack {

/// The whole number in an environment variable; `otherwise` where it is not set or empty.
inline std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text != nullptr && *text != '\0' ? std::strtoull(text, nullptr, 0) : otherwise;
}

/// Whether tests take their time (MOTIONRACK_THOROUGH=1), as the part `seeds` of ./test --all does.
inline bool thorough() {
    return from_environment("MOTIONRACK_THOROUGH", 0) != 0;
}

/// How often a test tries: what the environment variable says; without it few every day, all where there is time.
inline std::uint64_t trials(const char* name, std::uint64_t everyday, std::uint64_t all) {
    return from_environment(name, thorough() ? all : everyday);
}

/// How many random programs, jobs or accesses a test draws: what the environment variable says; without it
/// MOTIONRACK_CASES_PERCENT of the everyday number, at least 1. Builds that are slow by their checks take a part.
inline std::uint64_t cases(const char* name, std::uint64_t everyday) {
    const std::uint64_t part = everyday * from_environment("MOTIONRACK_CASES_PERCENT", 100) / 100;
    return from_environment(name, part > 0 ? part : 1);
}

/// Where random tests begin: MOTIONRACK_SEED, or the same in every run.
inline std::uint64_t seed_from_environment(std::uint64_t otherwise = 1) {
    return from_environment("MOTIONRACK_SEED", otherwise);
}

}  // namespace motionrack
