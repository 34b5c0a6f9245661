// The computer's monotonic clock: reception times of frames and due times.
#pragma once

#include <motionrack/base/time.hpp>

namespace motionrack::dds {

/// Returns the time since an instant before the program started; the same in all processes of a computer.
Instant monotonic_now();
/// Returns at `when` or later, or earlier on a signal: check the clock.
void sleep_until(Instant when);

}  // namespace motionrack::dds
