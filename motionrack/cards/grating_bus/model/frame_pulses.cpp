// Computes the instants and sequence numbers of pulses.
#include <motionrack/base/hash_bits.hpp>
#include <motionrack/cards/grating_bus/model/frame_pulses.hpp>

namespace motionrack::grating_bus {

std::int64_t scatter(std::uint32_t seed, std::int64_t n, std::int64_t max_delay) {
    const std::uint64_t mixed = mixed_bits(seed * golden_step + static_cast<std::uint64_t>(n));
    return static_cast<std::int64_t>(mixed % static_cast<std::uint64_t>(max_delay + 1));
}

void FramePulses::advance() {
    ++state_.number;
    state_.next = grid() + Duration{scatter(settings_.seed, state_.number, jitter_.count())};
}

void FramePulses::note_edge(Instant now) {
    const Duration period = settings_.period;
    if (state_.last_edge < Instant{0}) {
        sequence_ = 0;
    } else if (settings_.role == CardRole::host || now - state_.last_edge < period + period / 2) {
        ++sequence_;
    } else {
        const auto periods = static_cast<std::uint32_t>((now - state_.last_edge + period / 2) / period);
        sequence_ += periods;
        if (periods > 1) {
            errors_.count(ErrorCounter::missed_edges, periods - 1);
            errors_.report(BusCondition::missed_edges, periods - 1, sequence_);
        }
    }
    state_.last_edge = now;
}

void FramePulses::set_jitter(Duration jitter, Instant now) {
    jitter_ = jitter;
    if (now >= grid()) return;
    --state_.number;
    advance();
}

}  // namespace motionrack::grating_bus
