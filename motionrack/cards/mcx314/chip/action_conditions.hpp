// Conditions of the synchronous actions of an MCX314As: those that an axis selects in SM6 are noted until the end of
// the tick or write, when the axes act.
#pragma once

#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class ActionConditions {
  public:
    explicit ActionConditions(State& state) : state_(state) {}

    /// Handles a condition: its axes act at the end of the tick or write.
    void note(int a, Field condition);
    /// Handles comparisons that have become true, as bits of RR3.
    void note_comparisons(int a, unsigned risen);
    /// Determines the comparisons with subscribers: interrupts of WR1 and conditions of SM6.
    void hear_comparisons(int a);

  private:
    State& state_;
};

}  // namespace motionrack::mcx314
