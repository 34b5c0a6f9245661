// The RTC5 of a rack, for those who give it commands.
#pragma once

#include <motionrack/cards/rtc5/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <string_view>

namespace motionrack::rack {

/// nullptr if the rack has no such card, or it is of another type.
rtc5::Card* rtc5_card_of(Rack& rack, std::string_view name);

}  // namespace motionrack::rack
