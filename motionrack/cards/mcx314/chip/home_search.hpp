// The automatic home search of an MCX314As. ChipHomeSearch::HomeSteps in the .cpp file is the table of its states.
#pragma once

#include <motionrack/cards/mcx314/chip/comparators.hpp>
#include <motionrack/cards/mcx314/chip/drives.hpp>
#include <motionrack/cards/mcx314/chip/encoder_inputs.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/fast_forward.hpp>
#include <motionrack/cards/mcx314/chip/generators.hpp>
#include <motionrack/cards/mcx314/chip/input_pins.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

/// Returns true if the event that a step of the home search waits for has occurred.
bool home_input(const State& state, int a, int step);
/// Returns true if the drive of a home search must stop as by a stop input; called in step 1 of a tick.
bool home_found(State& state, int a);

/// The searches of the four axes, and the deviation counter clear pulse at their end.
class ChipHomeSearch {
  public:
    ChipHomeSearch(State& state, sim::Kernel& kernel, sim::DeviceId id, EventRequests& requests, InputPins& inputs,
                   EncoderInputs& encoders, Comparators& comparators, FastForward& forward, Generators& generators,
                   Drives& drives)
        : state_(state),
          kernel_(kernel),
          id_(id),
          requests_(requests),
          inputs_(inputs),
          encoders_(encoders),
          comparators_(comparators),
          forward_(forward),
          generators_(generators),
          drives_(drives) {}

    /// Executes command 62h: starts the home search of axis `a`, unless it is driving.
    void start(int a);
    /// Continues the searches whose drive has ended; called at the end of a tick.
    void look();
    /// Begins the deviation counter clear pulse, if EM enables it.
    void ask_clear(int a);

  private:
    struct HomeSteps;

    /// Starts the drive of the state `hmst` (RR2 HMST).
    void go(int a, int hmst);
    void finish(int a);

    State& state_;
    sim::Kernel& kernel_;
    const sim::DeviceId id_;
    EventRequests& requests_;
    InputPins& inputs_;
    EncoderInputs& encoders_;
    Comparators& comparators_;
    FastForward& forward_;
    Generators& generators_;
    Drives& drives_;
};

}  // namespace motionrack::mcx314
