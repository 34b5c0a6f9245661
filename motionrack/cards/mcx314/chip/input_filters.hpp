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

    /// Applies a write to EM of axis `a`: a new filter begins with the level of its wire, a disabled one ends.
    void set(int a);
    /// Records a changed wire level (0, 1). Returns false if the pin has a filter, which passes the change on after its
    /// delay.
    bool passes(int pin, int wire_level);
    /// Samples the inputs for `tick`, before the tick is executed.
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
