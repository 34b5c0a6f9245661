// Writes audit entries of unauthenticated clients, singly or as summaries.
#include <fmt/format.h>

#include <motionrack/frontends/server/unknown_sender_log.hpp>
#include <utility>

namespace motionrack::server {

void UnknownSenderLog::add(AuditEntry entry, const std::string& network, Time now) {
    if (of_a_network_.take(network, now) && of_all_.take("", now)) return write_(entry);
    if (counted_.empty()) begun_ = now;
    const bool alone = counted_.count(network) != 0 || counted_.size() < max_networks;
    Counted& counted = counted_[alone ? network : ""];
    ++counted.count;
    counted.last = std::move(entry);
}

void UnknownSenderLog::tick(Time now) {
    if (counted_.empty() || now - begun_ < period) return;
    for (auto& [network, counted] : std::exchange(counted_, {})) {
        AuditEntry& entry = counted.last;
        if (network.empty()) entry.address = "other addresses";
        entry.outcome = fmt::format("{} more within {} s; the last: {}", counted.count, period.count(), entry.outcome);
        write_(entry);
    }
}

}  // namespace motionrack::server
