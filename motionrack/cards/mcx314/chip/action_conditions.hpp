// Conditions of the synchronous actions of an MCX314As: those that an axis selects in SM6 are noted until the end of
// the tick or write, when the axes act.
#pragma once

#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

class ActionConditions {
  public:
    explicit ActionConditions(State& state) : state_(state) {}

    /// Notes that `condition` (a field of SM6) has occurred on axis `a`. If SM6 of `a` selects it, axis `a` and the
    /// axes that SM6 names act at the end of the tick or write.
    void note(int a, Field condition);
    /// Notes the comparisons of axis `a` that have become true; `risen`: bits of RR3.
    void note_comparisons(int a, unsigned risen);
    /// Updates the comparisons that axis `a` must evaluate: those that WR1 enables as interrupts or SM6 selects as
    /// conditions.
    void hear_comparisons(int a);

  private:
    State& state_;
};

}  // namespace motionrack::mcx314
