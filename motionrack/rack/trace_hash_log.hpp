// Writes the event trace hash of a rack to a file, to compare programs in different languages that use the library.
#pragma once

#include <motionrack/sim/kernel.hpp>

namespace motionrack::rack {

/// Environment variable with the name of the file.
inline constexpr const char* trace_hash_variable = "MOTIONRACK_TRACE_HASH";

/// If the variable is set, appends "HASH TICKS" to the file: hash of the wires and conditions, and the rack's time in
/// ticks of 100 ps. Called at the end of every started rack, including copies. Write errors are ignored.
void report_history(const sim::Kernel& kernel) noexcept;

}  // namespace motionrack::rack
