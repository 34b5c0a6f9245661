// The history of a rack in a line, so that programs in different languages can be compared that use the library.
#pragma once

#include <motionrack/sim/kernel.hpp>

namespace motionrack::rack {

/// The environment variable that names the file.
inline constexpr const char* history_variable = "MOTIONRACK_HISTORY";

/// If it is set, appends "HASH TICKS" to the file: what the wires and the conditions were, and the rack's time in ticks
/// of 100 ps. Every rack that was started does so when it ends, copies too. A file that cannot be written is left.
void tell_history(const sim::Kernel& kernel) noexcept;

}  // namespace motionrack::rack
