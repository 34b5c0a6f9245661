// What must hold of the panel whatever it is asked; for its own test and for libFuzzer.
#pragma once

#include <string>
#include <string_view>

namespace motionrack::panel::fuzz {

/// Each line is JSON, {"order":NAME, fields}; somebody who may do everything asks it of a small rack. A sentence about
/// what did not hold; empty: each was answered once, with JSON, and the machine ends.
std::string check_orders(std::string_view bytes);

}  // namespace motionrack::panel::fuzz
