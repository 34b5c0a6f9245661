// Reads values of the chip and its registers by readable names such as "x.LP".
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <string_view>

namespace motionrack::mcx314 {

/// Returns the value of "x.LP", "MODE", or a readable register of `map` as the bus shows it; without side effects.
/// Errors: invalid_input, with the available names; the sentence calls the card `card` and the name `quoted`.
Result<std::int64_t> value_by_name(const Chip& chip, const CardMap& map, std::string_view card, std::string_view name,
                                   std::string_view quoted);

}  // namespace motionrack::mcx314
