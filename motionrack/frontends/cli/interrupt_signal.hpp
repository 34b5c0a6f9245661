// Ctrl-C, SIGTERM and a closed terminal (SIGHUP) request the running command to decelerate all axes to a stop and keep
// its results. A closed reader (SIGPIPE) does not end the program: it finishes its work and writes files completely.
#pragma once

#include <atomic>

namespace motionrack::cli {

/// Set by the first signal after stop_on_signals().
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler has no argument for it
extern std::atomic<bool> stop_asked;

/// From now on Ctrl-C, SIGTERM and SIGHUP set stop_asked. A SIGHUP that was ignored at the start (nohup) stays ignored.
void stop_on_signals();

}  // namespace motionrack::cli
