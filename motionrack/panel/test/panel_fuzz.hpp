// Invariants of the panel for any request; used by its own test and by libFuzzer.
#pragma once

#include <string>
#include <string_view>

namespace motionrack::panel::fuzz {

/// Each line is JSON, {"command":NAME, fields}; a client with all permissions sends it to a small rack. Returns a
/// sentence about a violation; empty: each request was answered once, with JSON, and the machine ended.
std::string check_orders(std::string_view bytes);

}  // namespace motionrack::panel::fuzz
