// Signal handler.
#include <csignal>
#include <motionrack/frontends/cli/interrupt_signal.hpp>

namespace motionrack::cli {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler has no argument for it
std::atomic<bool> stop_asked{false};

void stop_on_signals() {
    const auto ask = [](int) { stop_asked.store(true); };
    std::signal(SIGINT, ask);
    std::signal(SIGTERM, ask);
    // nohup: a program started with SIGHUP ignored outlives its terminal.
    if (std::signal(SIGHUP, ask) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace motionrack::cli
