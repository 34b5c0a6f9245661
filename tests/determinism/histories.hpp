// What every build must give bit for bit: the histories of the examples' programs and of the example racks.
#pragma once

#include <filesystem>
#include <string>

namespace motionrack {

/// The numbered examples' programs on the router, a line each: name, hash of the history, ticks of 100 ps that it took.
std::string example_histories(const std::filesystem::path& root);

/// The example racks, each with its program or by itself for half a second, a line each: name, hash of its state with
/// all places, velocities and counts, hash of its history, ticks that it took.
std::string rack_histories(const std::filesystem::path& root);

}  // namespace motionrack
