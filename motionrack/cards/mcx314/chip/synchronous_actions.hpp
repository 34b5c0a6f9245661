// Synchronous actions of an MCX314As: a condition of one axis makes this and other axes act, in the same tick.
#pragma once

#include <motionrack/cards/mcx314/chip/command_executor.hpp>
#include <motionrack/cards/mcx314/chip/drives.hpp>
#include <motionrack/cards/mcx314/chip/encoder_inputs.hpp>
#include <motionrack/cards/mcx314/chip/event_requests.hpp>
#include <motionrack/cards/mcx314/chip/fast_forward.hpp>
#include <motionrack/cards/mcx314/chip/generators.hpp>
#include <motionrack/cards/mcx314/chip/home_search.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class SynchronousActions {
  public:
    SynchronousActions(State& state, EventRequests& requests, const EncoderInputs& encoders, FastForward& forward,
                       Generators& generators, Drives& drives, ChipHomeSearch& homes, CommandExecutor& commands)
        : state_(state),
          requests_(requests),
          encoders_(encoders),
          forward_(forward),
          generators_(generators),
          drives_(drives),
          homes_(homes),
          commands_(commands) {}

    /// Executes the actions of all conditions noted so far; called at the end of a tick or a write. Conditions that
    /// these actions cause are handled in the next tick.
    void act();

  private:
    void act_alone(int a);

    State& state_;
    EventRequests& requests_;
    const EncoderInputs& encoders_;
    FastForward& forward_;
    Generators& generators_;
    Drives& drives_;
    ChipHomeSearch& homes_;
    CommandExecutor& commands_;
};

}  // namespace motionrack::mcx314
