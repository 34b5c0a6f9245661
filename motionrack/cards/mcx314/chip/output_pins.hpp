// Drives the output pins: computes a level on demand, or sets the wires that have listeners.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/chip_wires.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/motion_law.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/cards/mcx314/chip/status_registers.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

class OutputPins {
  public:
    OutputPins(State& state, sim::Kernel& kernel, const ChipWires& wires, EventRequests& requests, const MotionLaw& law,
               const StatusRegisters& status)
        : state_(state), kernel_(kernel), wires_(wires), requests_(requests), law_(law), status_(status) {}

    /// Sets nOUT0..3 of every axis to the bits of WR4.
    void set_general_outputs();
    /// Returns the level (0, 1) at `tick` of a pin that is computed on demand (ChipWires::output_pin).
    int level_at(int pin, std::int64_t tick) const;
    /// Determines the axes with listeners on their output wires; every pulse of such an axis is an event.
    void note_followers();
    /// Sets the output wires that have listeners to their levels.
    void show(Instant now);

  private:
    int pulse_level(int a, int which, bool pulse, int direction) const;
    int output_level(int a, int output) const;
    int drive_level(int a, std::int64_t tick) const;

    State& state_;
    sim::Kernel& kernel_;
    const ChipWires& wires_;
    EventRequests& requests_;
    const MotionLaw& law_;
    const StatusRegisters& status_;
};

}  // namespace motionrack::mcx314
