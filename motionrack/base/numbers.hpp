// Parses decimal numbers in the text of users and files.
#pragma once

#include <string_view>

namespace motionrack {

/// Returns the number that the complete text is; NaN if it is empty or not a number.
double number_of(std::string_view text);

}  // namespace motionrack
