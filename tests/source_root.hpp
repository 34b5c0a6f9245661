// Where the tests find pages, examples and sources.
#pragma once

#include <filesystem>

namespace motionrack {

/// The tree that the tests were built from.
inline const std::filesystem::path source_root = MOTIONRACK_SOURCE_DIR;

}  // namespace motionrack
