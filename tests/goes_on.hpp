// End condition of random tests.
#pragma once

#include <cstdint>

namespace motionrack {

/// Returns true if another case is due after `made`: always below `count`, and below `max` until `shown`, that is until
/// a case has shown the behaviour under test.
inline bool goes_on(std::uint64_t made, std::uint64_t count, std::uint64_t max, bool shown) {
    return made < count || (made < max && !shown);
}

}  // namespace motionrack
