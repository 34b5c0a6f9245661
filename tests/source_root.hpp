// Where the tests find pages, examples and sources.
#pragma once

#include <filesystem>
#include <string>

namespace motionrack {

/// The tree that the tests were built from, without a slash at its end. Its name stands in a source of its own, so that
/// all others are the same whatever folder they are built in, and come out of a compiler's cache.
std::string source_dir();

inline const std::filesystem::path source_root = source_dir();

}  // namespace motionrack
