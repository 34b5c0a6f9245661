// The EVENT word: enables, the latched word, zeroing by zero pulse and reference, edges of the stops, the interrupt.
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/pins.hpp>
#include <motionrack/cards/databoard4002/model/state.hpp>

namespace motionrack::databoard4002 {

class EventRegister {
  public:
    /// `state` is part of the card's state and must outlive this.
    EventRegister(EventState& state, Pins& pins) : state_(state), pins_(pins) {}

    /// Returns the latched word if an event is pending, else the present one.
    std::uint8_t word() const { return state_.pending ? state_.latched : state_.event; }
    bool pending() const { return state_.pending != 0; }

    /// Sets bits. Events that are not enabled do not happen.
    void raise(std::uint8_t bits);
    /// Clears bits of the present word.
    void clear(std::uint8_t bits) { state_.event = static_cast<std::uint8_t>(state_.event & ~bits); }
    /// Latches the word if it has an enabled event and none is pending.
    void check();

    /// Executes a byte written to C4, up to subscribe_zero() and check(); returns the word for the latch of DATA.
    std::uint8_t enable(std::uint8_t value);
    /// A zero pulse is computed only while it is awaited, so an idle encoder costs no time.
    void subscribe_zero() { pins_.subscribe(zero_pin, (state_.armed & event::ZERO) != 0); }
    /// Disarms the zero and reference event when its condition becomes true; returns its bits, else 0.
    std::uint8_t take_armed();

    /// Records the active stops without raising an event for them.
    void take_stops();
    /// Raises the end-stop event if a stop became active; returns the STAT bits of the active ones.
    std::uint8_t note_stops();

    void update_interrupt(bool ready);

  private:
    bool zero_condition() const;
    std::uint8_t active_stops() const { return pins_.inputs() & (stat::ESL | stat::ESR | stat::EMS); }

    EventState& state_;
    Pins& pins_;
};

}  // namespace motionrack::databoard4002
