// The interrupt line, and the flags of RR3 behind it (request_interrupt sets them).
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/chip_wires.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

class Interrupts {
  public:
    Interrupts(State& state, sim::Kernel& kernel, const ChipWires& wires, EventRequests& requests)
        : state_(state), kernel_(kernel), wires_(wires), requests_(requests) {}

    /// Sets the interrupt line after an event; the kernel ends its run when the line becomes active (Low).
    void update();
    /// Clears the bits in `mask` of RR3, which the host has read.
    void clear(std::uint16_t mask);

  private:
    State& state_;
    sim::Kernel& kernel_;
    const ChipWires& wires_;
    EventRequests& requests_;
};

}  // namespace motionrack::mcx314
