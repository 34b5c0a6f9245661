// The levels that the logic of a card drives on the bus lines, through its level shifters.
#pragma once

#include <cstdint>
#include <motionrack/cards/grating_bus/model/card_state.hpp>
#include <motionrack/cards/grating_bus/model/lines.hpp>
#include <motionrack/cards/grating_bus/model/moment.hpp>
#include <motionrack/cards/grating_bus/model/settings.hpp>

namespace motionrack::grating_bus {

class LineOutputs {
  public:
    /// `state` is part of the card's state; it and `settings` must outlive this.
    LineOutputs(LineOutputsState& state, const CardSettings& settings) : state_(state), settings_(settings) {}

    std::uint32_t clk() const { return state_.clk; }
    void set_clk(std::uint32_t level) { state_.clk = level; }
    void set_address(int address) { state_.addr = static_cast<std::uint32_t>(address); }
    /// Returns true from a reset to the first pulse: all outputs are off.
    bool quiet() const { return state_.quiet != 0; }
    void wake() { state_.quiet = 0; }

    /// Sets the levels of a state at its begin. The address follows when READ is sampled low: Bus::give_addresses.
    void enter(State state);
    /// Sets the levels of a frame in progress.
    void take(const Outputs& outputs);
    /// Drives or leaves the lines. `off`: the card is switched off.
    void drive(Lines& lines, int driver, bool off) const;

  private:
    LineOutputsState& state_;
    const CardSettings& settings_;
};

}  // namespace motionrack::grating_bus
