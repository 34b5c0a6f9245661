// When a random test has made enough cases.
#pragma once

#include <cstdint>

namespace motionrack {

/// Whether there is another case after `made`: as many as asked for, `count`; and up to `max`, as many as it takes
/// until they have shown what they are for.
inline bool goes_on(std::uint64_t made, std::uint64_t count, std::uint64_t max, bool shown) {
    return made < count || (made < max && !shown);
}

}  // namespace motionrack
