// The version of the program that reads files of format 1.
#pragma once

#include <string_view>

namespace motionrack::trace {

/// Version that writes and reads recordings and tables of sweeps of format 1.
inline constexpr std::string_view format_1_version = "0.1.0";

}  // namespace motionrack::trace
