// Reads the blocks of code of a Markdown page.
#pragma once

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack {

/// A block of a page: ```INFO, its lines, ```.
struct FencedBlock {
    std::string info, text;
};

/// Returns the blocks whose fences begin their lines, in the order of the page.
inline std::vector<FencedBlock> fenced_blocks(const std::string& page) {
    std::vector<FencedBlock> out;
    std::istringstream in(page);
    bool inside = false;
    for (std::string line; std::getline(in, line);) {
        const bool fence = line.rfind("```", 0) == 0;
        if (fence && !inside) out.push_back({line.substr(3), ""});
        if (!fence && inside) out.back().text += line + "\n";
        if (fence) inside = !inside;
    }
    return out;
}

/// Returns the texts of the blocks in one language.
inline std::vector<std::string> code_in_page(const std::string& page, std::string_view language) {
    std::vector<std::string> out;
    for (const FencedBlock& block : fenced_blocks(page))
        if (block.info == language) out.push_back(block.text);
    return out;
}

}  // namespace motionrack
