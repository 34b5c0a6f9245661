// The computer's monotonic clock: gives the reception times of frames, and sleeps until their due times.
#pragma once

#include <motionrack/base/time.hpp>

namespace motionrack::dds {

/// Returns the time since a fixed instant before the program started, the same instant for all processes of a computer.
Instant monotonic_now();
/// Sleeps until `when`. A signal can end the sleep earlier, so check the clock afterwards.
void sleep_until(Instant when);

}  // namespace motionrack::dds
