// Executes commands given by wires: nEXPP and nEXPM for drives and hand wheels, EXPLSN for single steps.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/drives.hpp>
#include <motionrack/cards/mcx314/chip/generators.hpp>
#include <motionrack/cards/mcx314/chip/input_pins.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class ExternalDrives {
  public:
    ExternalDrives(State& state, InputPins& inputs, Generators& generators, Drives& drives)
        : state_(state), inputs_(inputs), generators_(generators), drives_(drives) {}

    /// Applies the external drive mode in WR3 of axis `a`, whose previous word was `before`.
    void change_mode(int a, std::uint16_t before);
    /// Executes, after a tick, the drives and steps that the changed wires request.
    void execute_requests();

  private:
    void sample_drive(int a);
    void sample_wheel(int a);

    State& state_;
    InputPins& inputs_;
    Generators& generators_;
    Drives& drives_;
};

}  // namespace motionrack::mcx314
