// Audit budget of unauthenticated clients: a burst, then one line per ten seconds and network and one per second in
// total. The rest are counted and summarised in one line per minute and network.
//
//  pair 403 ─► within the budget: a line of its own
//         └──► beyond it: counted ── a minute ──► "pair: 2840 more within 60 s; the last: Not paired: .."
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <motionrack/auth/rate_limit.hpp>
#include <motionrack/frontends/server/settings.hpp>
#include <string>

namespace motionrack::server {

class UnknownSenderLog {
  public:
    using Time = std::chrono::steady_clock::time_point;
    using Write = std::function<void(const AuditEntry&)>;
    static constexpr std::chrono::seconds period{60};
    /// Maximum number of networks counted separately; the others are counted together.
    static constexpr std::size_t max_networks = 16;

    explicit UnknownSenderLog(Write write) : write_(std::move(write)) {}

    void add(AuditEntry entry, const std::string& network, Time now);
    /// Called periodically; writes the summaries.
    void tick(Time now);

  private:
    struct Counted {
        std::int64_t count = 0;
        AuditEntry last;
    };
    Write write_;
    auth::RateLimit of_a_network_{20, 0.1}, of_all_{100, 1};
    std::map<std::string, Counted> counted_;
    Time begun_{};  ///< start of the period
};

}  // namespace motionrack::server
