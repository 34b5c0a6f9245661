// The input pins of the axes and EXPLSN: holds their levels and subscribes to the wires that matter.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/chip_wires.hpp>
#include <motionrack/cards/mcx314/chip/options.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

class InputPins {
  public:
    static constexpr std::uint32_t step_wire = 1u << axes_of_chip;  ///< bit of EXPLSN in State::sampled

    InputPins(State& state, const ChipOptions& options, sim::Kernel& kernel, sim::DeviceId id, const ChipWires& wires)
        : state_(state), extended_(options.extended()), kernel_(kernel), id_(id), wires_(wires) {}

    /// Subscribes to the inputs that matter to axis `a`, and reads their levels. Disabled inputs are not subscribed, so
    /// a wire that is computed on demand (an index) costs no time.
    void set_wants(int a);
    /// Returns the eight input levels of one axis, as RR4 and RR5 show them; filtered inputs show the output of the
    /// filter.
    std::uint16_t input_levels(int a) const;
    /// Returns true if nEXPP and nEXPM are the lines A and B of a hand wheel.
    bool turns_by_wire(int a) const;
    /// Notes a change of an axis' input (`pin`: 16 * axis + Pin): if it is nEXPP or nEXPM, the next tick samples it.
    void hear_external(int pin);
    /// Stores the level (0, 1) of EXPLSN.
    void hear_step_wire(int wire_level);

  private:
    unsigned inputs_of_extension(int a) const;

    State& state_;
    const bool extended_;
    sim::Kernel& kernel_;
    const sim::DeviceId id_;
    const ChipWires& wires_;
};

}  // namespace motionrack::mcx314
