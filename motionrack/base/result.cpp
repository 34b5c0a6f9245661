// Failed assertions: print message and location, then terminate, so that a terminate handler may stop real cards.
#include <cstdio>
#include <exception>
#include <motionrack/base/result.hpp>

namespace motionrack {

void assertion_failed(const char* condition, const char* file, int line) noexcept {
    std::fprintf(stderr, "motionrack: internal error: '%s' does not hold at %s:%d. Please report it.\n", condition,
                 file, line);
    std::terminate();
}

}  // namespace motionrack
