// Subprograms beside a part program, each in a file of its own.
#pragma once

#include <filesystem>
#include <motionrack/control/gcode/settings.hpp>
#include <string>

namespace motionrack::rack {

/// Returns the path of subprogram o<name>: name.ngc in this folder.
std::filesystem::path subprogram_file(const std::filesystem::path& folder, const std::string& name);

/// Returns a source that reads subprogram o<name> from name.ngc in this folder; files of up to 64 MiB.
control::gcode::SubprogramSource subprograms_in(std::filesystem::path folder);

}  // namespace motionrack::rack
