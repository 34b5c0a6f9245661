// The registers RR0 .. RR7 as the bus shows them, without side effects.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/comparators.hpp>
#include <motionrack/cards/mcx314/chip/input_pins.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class StatusRegisters {
  public:
    StatusRegisters(const State& state, const InputPins& inputs, const Comparators& comparators)
        : state_(state), inputs_(inputs), comparators_(comparators) {}

    /// Returns the register at a byte offset of the bus, 0 .. 0Eh.
    std::uint16_t value(std::uint32_t offset) const;
    /// Returns the main status register RR0.
    std::uint16_t main_status() const;
    /// Return the status registers RR1 and RR2 of axis `a`.
    std::uint16_t status1(int a) const;
    std::uint16_t status2(int a) const;

  private:
    const State& state_;
    const InputPins& inputs_;
    const Comparators& comparators_;
};

}  // namespace motionrack::mcx314
