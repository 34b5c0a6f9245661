// Decimal numbers in text by users and files.
#pragma once

#include <string_view>

namespace motionrack {

/// The number of the complete text; NaN if it is not a number or empty.
double number_of(std::string_view text);

}  // namespace motionrack
