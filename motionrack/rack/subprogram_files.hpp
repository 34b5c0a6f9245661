// Subprograms that lie beside a part program, each in a file of its own.
#pragma once

#include <filesystem>
#include <motionrack/control/gcode/settings.hpp>
#include <string>

namespace motionrack::rack {

/// Where o<name> is: name.ngc in this folder.
std::filesystem::path subprogram_file(const std::filesystem::path& folder, const std::string& name);

/// o<name> as name.ngc in this folder; files of up to 64 MiB.
control::gcode::SubprogramSource subprograms_in(std::filesystem::path folder);

}  // namespace motionrack::rack
