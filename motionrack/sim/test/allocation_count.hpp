// Counts the allocations of this test program: what runs in virtual time must not make any.
#pragma once

#include <cstdint>

namespace motionrack::sim {

/// Calls of operator new since the program began.
std::uint64_t allocations();

}  // namespace motionrack::sim
