// The pulses that start frames, with their sequence number: those that a host outputs, and the edges that a slave sees.
#pragma once

#include <cstdint>
#include <motionrack/cards/grating_bus/model/card_state.hpp>
#include <motionrack/cards/grating_bus/model/error_counters.hpp>
#include <motionrack/cards/grating_bus/model/settings.hpp>

namespace motionrack::grating_bus {

/// Returns the jitter of pulse `n` of a host with this seed, 0 .. max_delay ticks; the same on every computer.
std::int64_t scatter(std::uint32_t seed, std::int64_t n, std::int64_t max_delay);

class FramePulses {
  public:
    /// The references are parts of the card's state; `settings` must outlive it.
    FramePulses(PulseState& state, std::uint32_t& sequence, Duration& jitter, const CardSettings& settings,
                ErrorCounters& errors)
        : state_(state), sequence_(sequence), jitter_(jitter), settings_(settings), errors_(errors) {}

    /// Returns the number of the last pulse.
    std::uint32_t sequence() const { return sequence_; }
    /// Returns the instant of a host's next pulse; never on other cards.
    Instant next() const { return state_.next; }
    /// Returns the instant at which the clk of a host falls.
    Instant fall() const { return state_.fall; }
    void set_fall(Instant at) { state_.fall = at; }
    /// Returns the instant of the next pulse without jitter.
    Instant grid() const { return settings_.offset + state_.number * settings_.period; }

    /// Schedules the first pulse of a host.
    void begin() { state_.next = settings_.offset; }
    /// Schedules the pulse after the present one.
    void advance();
    /// Updates the sequence number and the missed edges at a pulse or an edge.
    void note_edge(Instant now);
    void set_jitter(Duration jitter, Instant now);

  private:
    PulseState& state_;
    std::uint32_t& sequence_;
    Duration& jitter_;
    const CardSettings& settings_;
    ErrorCounters& errors_;
};

}  // namespace motionrack::grating_bus
