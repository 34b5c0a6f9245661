// Build-time settings of a card.
#pragma once

#include <cstdint>
#include <motionrack/cards/rtc5/map.hpp>

namespace motionrack::rtc5 {

struct Settings {
    std::int64_t list_memory = max_list_memory;  ///< positions, 16 .. 1048576
    std::int64_t list1 = 4000, list2 = 4000;     ///< positions of list 1 and 2; the remainder is list 3
};

Result<void> check(const Settings& settings);

}  // namespace motionrack::rtc5
