// Environment of the Windows process: program and library may use different C libraries, each with a copy from its
// start.
#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <motionrack/frontends/mcx314lib/environment.hpp>

namespace motionrack::mcx314lib {

std::string environment_variable(const char* name) {
    std::string value;
    for (DWORD size = ::GetEnvironmentVariableA(name, nullptr, 0); size > value.size();) {
        value.resize(size);
        size = ::GetEnvironmentVariableA(name, value.data(), size);
        if (size < value.size()) return value.substr(0, size);
    }
    return {};
}

}  // namespace motionrack::mcx314lib
