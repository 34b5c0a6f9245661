// The computer's monotonic clock: when frames were received, and when the next one is due.
#pragma once

#include <motionrack/base/time.hpp>

namespace motionrack::dds {

/// Since some instant before the program started; the same in all processes of a computer.
Instant monotonic_now();
/// Returns at `when` or later, or earlier if a signal comes: look at the clock.
void sleep_until(Instant when);

}  // namespace motionrack::dds
