// Ctrl-C, SIGTERM and a terminal that is closed (SIGHUP): a request to the running command, which then brings
// everything to rest and keeps its results. A reader that goes (SIGPIPE) ends nothing: work is finished, files are
// written whole.
#pragma once

#include <atomic>

namespace motionrack::cli {

/// Set by the first signal after stop_on_signals().
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal finds nothing else
extern std::atomic<bool> stop_asked;

/// From now on Ctrl-C, SIGTERM and SIGHUP set stop_asked; SIGHUP not where it was ignored at the start (nohup).
void stop_on_signals();

}  // namespace motionrack::cli
