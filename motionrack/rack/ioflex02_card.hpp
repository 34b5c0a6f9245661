// The IOFLEX02 of a rack, for those who act on the card itself.
#pragma once

#include <motionrack/cards/ioflex02/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack {

/// nullptr if the rack has no such card, or it is of another type.
ioflex02::Card* ioflex02_card_of(Rack& rack, std::string_view name);

}  // namespace motionrack::rack
