// Ctrl-C and SIGTERM: what was asked of the running command, which then brings everything to rest and keeps what it
// has.
#pragma once

#include <atomic>

namespace motionrack::cli {

/// Set by the first signal after stop_on_signals().
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal finds nothing else
extern std::atomic<bool> stop_asked;

/// From now on Ctrl-C and SIGTERM set stop_asked.
void stop_on_signals();

}  // namespace motionrack::cli
