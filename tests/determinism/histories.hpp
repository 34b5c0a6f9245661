// Event traces that every build must reproduce bit for bit: those of the example programs and of the example racks.
#pragma once

#include <filesystem>
#include <string>

namespace motionrack {

/// Runs the programs of the numbered examples on the router. Returns a line for each: name, hash of the event trace,
/// duration in ticks of 100 ps.
std::string example_histories(const std::filesystem::path& root);

/// Runs the example racks, each with its program or without one for half a second. Returns a line for each: name, hash
/// of its state with all positions, velocities and counts, hash of its event trace, duration in ticks of 100 ps.
std::string rack_histories(const std::filesystem::path& root);

}  // namespace motionrack
