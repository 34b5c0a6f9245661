// Reads a file of the tree as text.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace motionrack {

/// Returns the bytes of `path`; "" if it cannot be read.
inline std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

}  // namespace motionrack
