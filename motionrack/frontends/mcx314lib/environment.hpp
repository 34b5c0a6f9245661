// A variable of the process' environment: windows/ has the same for Windows.
#pragma once

#include <string>

namespace motionrack::mcx314lib {

/// As it is now; empty where it is not set.
std::string environment_variable(const char* name);

}  // namespace motionrack::mcx314lib
