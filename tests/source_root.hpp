// Path of the source tree, in which the tests find pages, examples and sources.
#pragma once

#include <filesystem>
#include <string>

namespace motionrack {

/// Returns the tree from which the tests were built, without a trailing slash. A source file of its own holds the path,
/// so that a compiler cache can reuse all other files in any folder.
std::string source_dir();

inline const std::filesystem::path source_root = source_dir();

}  // namespace motionrack
