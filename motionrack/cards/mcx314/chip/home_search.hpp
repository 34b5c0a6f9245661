// The automatic home search of an MCX314As.
#pragma once

#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

/// True if the event that a step of the home search waits for has occurred.
bool home_input(const State& state, int a, int step);
/// In step 1 of a tick: true if the drive of a home search must stop, as by a stop input.
bool home_found(State& state, int a);

}  // namespace motionrack::mcx314
