// What a fuzz target states of every input: a law that an input breaks is printed, and the target ends there.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace motionrack::fuzz {

/// `seen`: the value that breaks the law, where it helps.
inline void require(bool holds, std::string_view law, std::string_view seen = {}) {
    if (holds) return;
    std::fprintf(stderr, "This does not hold: %.*s", static_cast<int>(law.size()), law.data());
    if (!seen.empty()) std::fprintf(stderr, " [%.*s]", static_cast<int>(seen.size()), seen.data());
    std::fputc('\n', stderr);
    std::abort();
}

}  // namespace motionrack::fuzz
