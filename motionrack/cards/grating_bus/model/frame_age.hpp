// Age of the frame published last: it becomes stale two periods after its time.
#pragma once

#include <cstdint>
#include <motionrack/cards/grating_bus/model/card_state.hpp>
#include <motionrack/cards/grating_bus/model/error_counters.hpp>
#include <motionrack/cards/grating_bus/model/settings.hpp>

namespace motionrack::grating_bus {

class FrameAge {
  public:
    /// `state` and `stale` are parts of the card's state; `settings` must outlive it.
    FrameAge(FrameAgeState& state, std::uint8_t& stale, const CardSettings& settings, const ErrorCounters& errors)
        : state_(state), stale_(stale), settings_(settings), errors_(errors) {}

    bool stale() const { return stale_ != 0; }
    /// Returns the instant from which the frame ages.
    Instant held_since() const { return state_.held_since; }
    /// Returns the instant at which the frame becomes stale; never: it is already stale.
    Instant next() const { return state_.stale_at; }

    /// Starts the wait for the first frame: without one, the data is stale after two periods.
    void begin() { state_.stale_at = 2 * settings_.period; }
    /// Records that a frame was published; it ages from `since`.
    void renew(std::uint32_t sequence, Instant since) {
        state_.published_sequence = sequence;
        state_.held_since = since;
        state_.any = 1;
        stale_ = 0;
        state_.stale_at = since + 2 * settings_.period;
    }
    void check(Instant now) {
        if (state_.stale_at > now) return;
        state_.stale_at = never;
        stale_ = 1;
        errors_.report(BusCondition::stale, state_.any != 0 ? std::int64_t{state_.published_sequence} : -1,
                       state_.held_since.count());
    }

  private:
    FrameAgeState& state_;
    std::uint8_t& stale_;
    const CardSettings& settings_;
    const ErrorCounters& errors_;
};

}  // namespace motionrack::grating_bus
