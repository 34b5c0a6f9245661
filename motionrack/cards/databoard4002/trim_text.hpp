// Text form of the trim table that comes with each card: "0.01 13799, 0.025 14051, 0.05 14339".
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/cards/databoard4002/arithmetic.hpp>
#include <string_view>

namespace motionrack::databoard4002 {

/// Parses 1 to 64 rows of V (up to 10, six decimals) and rate (1 .. 16,383), both ascending, separated by commas. An
/// empty text selects the table in the maker's description. Errors: invalid_input, with the row.
Result<Trim> trim_from_text(std::string_view text);

}  // namespace motionrack::databoard4002
