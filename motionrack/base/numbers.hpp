// Decimal text as users and files write it.
#pragma once

#include <string_view>

namespace motionrack {

/// The number that the whole of the text is; NaN if it is none (an empty one, too).
double number_of(std::string_view text);

}  // namespace motionrack
