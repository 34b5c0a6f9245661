// Manual accesses to a card's bus: finds the card and checks the access.
#pragma once

#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack {

/// Returns the card of that name. Errors: invalid_input, listing the available cards.
Result<Card*> card_named(Rack& rack, std::string_view name);

/// Returns the card if its bus supports an access of `bits` at `address` (see Card::bus_base) in that direction.
/// Errors: invalid_input; refused.
Result<Card*> card_for_access(Rack& rack, std::string_view name, int bits, std::uint32_t address, bool writing);

}  // namespace motionrack::rack
