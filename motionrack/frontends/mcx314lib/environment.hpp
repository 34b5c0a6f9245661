// Reads a variable of the process environment; windows/ has the counterpart for Windows.
#pragma once

#include <string>

namespace motionrack::mcx314lib {

/// Returns the current value; empty if the variable is not set.
std::string environment_variable(const char* name);

}  // namespace motionrack::mcx314lib
