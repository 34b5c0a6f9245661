// Pluralises a noun after a number.
#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace motionrack::rack {

/// Returns "1 move", "2 moves", "0 moves"; `many`: a plural other than with "s" ("axes").
template <std::integral N>
std::string count_noun(N number, std::string_view one, std::string_view many = {}) {
    std::string out = std::to_string(number);
    out += ' ';
    if (number == 1) return out.append(one);
    return many.empty() ? out.append(one).append("s") : out.append(many);
}

}  // namespace motionrack::rack
