// Assertion of the fuzz targets: prints a violated invariant and aborts.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace motionrack::fuzz {

/// `seen`: the violating value, if useful.
inline void require(bool holds, std::string_view law, std::string_view seen = {}) {
    if (holds) return;
    std::fprintf(stderr, "This does not hold: %.*s", static_cast<int>(law.size()), law.data());
    if (!seen.empty()) std::fprintf(stderr, " [%.*s]", static_cast<int>(seen.size()), seen.data());
    std::fputc('\n', stderr);
    std::abort();
}

}  // namespace motionrack::fuzz
