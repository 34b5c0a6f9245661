// Rows of the card type table that have files of their own.
#pragma once

#include <motionrack/rack/card_types.hpp>

namespace motionrack::rack {

CardType mcx314_type();
CardType databoard4002_type();

}  // namespace motionrack::rack
