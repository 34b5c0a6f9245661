// Expressions of ASMZ: numbers, characters, symbols, + - * and high:low.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace asmz {

/// The value of a symbol; throws if it has none.
using Lookup = std::function<int(const std::string& name)>;

/// `here`: the value of '*' where a number is expected. Throws old_host::Failure with the reason.
int value_of(std::string_view text, int here, const Lookup& lookup);

}  // namespace asmz
