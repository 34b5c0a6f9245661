// Subprograms that lie beside a part program, each in a file of its own.
#pragma once

#include <filesystem>
#include <motionrack/control/gcode/settings.hpp>

namespace motionrack::rack {

/// o<name> as name.ngc in this folder; files of up to 64 MiB.
control::gcode::SubprogramSource subprograms_in(std::filesystem::path folder);

}  // namespace motionrack::rack
