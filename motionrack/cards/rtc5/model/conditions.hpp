// Conditions that the RTC5 reports to the rack, and their messages.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::rtc5 {

enum class CardCondition : std::uint16_t {
    flag_set = 1,        ///< a: bit of the marking info, b: the tick
    start_lost = 2,      ///< b: the tick
    unwritten_place = 3  ///< a: position in the list memory, b: the tick
};

/// Returns the message of a condition, as in "card scan: at 0.012 s ...". `card`: the card's name.
std::string describe(const sim::Condition& condition, std::string_view card);

}  // namespace motionrack::rtc5
