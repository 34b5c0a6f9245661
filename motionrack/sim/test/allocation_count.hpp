// Counts the allocations of this test program: code in virtual time must not allocate.
#pragma once

#include <cstdint>

namespace motionrack::sim {

/// Calls of operator new since the program started.
std::uint64_t allocations();

}  // namespace motionrack::sim
