#include <cstdlib>
#include <motionrack/frontends/mcx314lib/environment.hpp>

namespace motionrack::mcx314lib {

std::string environment_variable(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

}  // namespace motionrack::mcx314lib
