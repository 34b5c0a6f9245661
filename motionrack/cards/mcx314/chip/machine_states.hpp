// Present state of each declared state machine (map.hpp), derived from the chip's working state: indices in its table.
#pragma once

#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

class MachineStates {
  public:
    MachineStates(const State& state, const sim::Kernel& kernel) : state_(state), kernel_(kernel) {}

    int drive_state(int a) const;
    int queue_state() const;
    int pattern_state() const;
    int stack_state() const;
    int step_state() const;
    int wire_state(int a, int minus) const;
    int home_state(int a) const;
    int filter_state(int a) const;
    int clear_state(int a) const;
    int action_state(int a) const;

  private:
    const State& state_;
    const sim::Kernel& kernel_;
};

}  // namespace motionrack::mcx314
