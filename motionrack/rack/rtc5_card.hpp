// Access to an RTC5 in a rack, for sending commands.
#pragma once

#include <motionrack/cards/rtc5/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack {

extern const CardPlugin rtc5_plugin;

/// Returns the card of that name; nullptr if the rack has no such card or the card is of another type.
rtc5::Card* rtc5_card_of(Rack& rack, std::string_view name);

}  // namespace motionrack::rack
