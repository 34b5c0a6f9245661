// Failed assertions: print message and location, then abort.
#include <cstdio>
#include <motionrack/base/result.hpp>

namespace motionrack {

void assertion_failed(const char* condition, const char* file, int line) noexcept {
    std::fprintf(stderr, "motionrack: internal error: '%s' does not hold at %s:%d. Please report it.\n", condition,
                 file, line);
    std::abort();
}

}  // namespace motionrack
