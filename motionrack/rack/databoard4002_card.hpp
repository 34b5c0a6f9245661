// Access to a DataBoard 4002 in a rack.
#pragma once

#include <motionrack/cards/databoard4002/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack {

/// Returns nullptr if the rack has no such card or the card is of another type.
const databoard4002::Card* databoard4002_card_of(Rack& rack, std::string_view name);

}  // namespace motionrack::rack
