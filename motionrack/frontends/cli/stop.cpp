// The signals' handler.
#include <csignal>
#include <motionrack/frontends/cli/stop.hpp>

namespace motionrack::cli {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal finds nothing else
std::atomic<bool> stop_asked{false};

void stop_on_signals() {
    const auto ask = [](int) { stop_asked.store(true); };
    std::signal(SIGINT, ask);
    std::signal(SIGTERM, ask);
}

}  // namespace motionrack::cli
