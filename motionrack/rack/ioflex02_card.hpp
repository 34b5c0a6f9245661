// The IOFLEX02 of a rack, for those who act on the card itself.
#pragma once

#include <motionrack/cards/ioflex02/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// nullptr if the rack has no such card, or it is of another type.
ioflex02::Card* ioflex02_card_of(Rack& rack, std::string_view name);

/// The compressed configuration image that the rack file gives the card at that address; empty if it gives none.
std::vector<std::uint8_t> ioflex02_image_at(const RackConfig& config, std::uint32_t base_address);

}  // namespace motionrack::rack
