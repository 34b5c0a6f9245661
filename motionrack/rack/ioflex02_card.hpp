// Access to an IOFLEX02 in a rack.
#pragma once

#include <motionrack/cards/ioflex02/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <string_view>
#include <vector>

namespace motionrack::rack {

extern const CardPlugin ioflex02_plugin;

/// Returns the card of that name; nullptr if the rack has no such card or the card is of another type.
ioflex02::Card* ioflex02_card_of(Rack& rack, std::string_view name);

/// Returns the compressed configuration image of the card at that address in the rack file; empty if the file gives
/// none.
std::vector<std::uint8_t> ioflex02_image_at(const RackConfig& config, std::uint32_t base_address);

}  // namespace motionrack::rack
