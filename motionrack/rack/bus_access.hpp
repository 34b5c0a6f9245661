// Accesses to a card's bus by hand: which card, and whether it has something there.
#pragma once

#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack {

/// Errors: invalid_input, with the cards that there are.
Result<Card*> card_named(Rack& rack, std::string_view name);

/// The card, if its bus has an access of `bits` at `address` (see Card::bus_base) in that direction. Errors:
/// invalid_input; refused.
Result<Card*> card_for_access(Rack& rack, std::string_view name, int bits, std::uint32_t address, bool writing);

}  // namespace motionrack::rack
