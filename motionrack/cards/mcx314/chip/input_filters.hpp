// Inputs of an MCX314As, sampled once per tick: filters, and the edges for EPCLR and synchronous actions.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/action_conditions.hpp>
#include <motionrack/cards/mcx314/chip/chip_wires.hpp>
#include <motionrack/cards/mcx314/chip/comparators.hpp>
#include <motionrack/cards/mcx314/chip/encoder_inputs.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/fast_forward.hpp>
#include <motionrack/cards/mcx314/chip/input_pins.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

class InputFilters {
  public:
    InputFilters(State& state, sim::Kernel& kernel, const ChipWires& wires, EventRequests& requests, InputPins& inputs,
                 ActionConditions& conditions, EncoderInputs& encoders, Comparators& comparators, FastForward& forward)
        : state_(state),
          kernel_(kernel),
          wires_(wires),
          requests_(requests),
          inputs_(inputs),
          conditions_(conditions),
          encoders_(encoders),
          comparators_(comparators),
          forward_(forward) {}

    /// Applies a write to EM: filters begin with the level of their wires, or end.
    void set(int a);
    /// Handles a change of a wire; returns false if the wire has a filter, which then takes the change.
    bool passes(int pin, int wire_level);
    /// Applies the samples of `tick` before the tick is executed.
    void sample(std::int64_t tick);

  private:
    bool sample_axis(int a, std::int64_t tick);
    bool sample_chip_filter(ChipFilter& filter, Field enable, bool seen, std::int64_t tick);
    void sample_edges(int a);

    State& state_;
    sim::Kernel& kernel_;
    const ChipWires& wires_;
    EventRequests& requests_;
    InputPins& inputs_;
    ActionConditions& conditions_;
    EncoderInputs& encoders_;
    Comparators& comparators_;
    FastForward& forward_;
};

}  // namespace motionrack::mcx314
