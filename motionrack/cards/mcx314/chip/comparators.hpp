// Comparisons of LP or EP with COMP+ and COMP-.
#pragma once

#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

/// True if interrupts, software limits or outputs depend on the comparisons with COMP+ and COMP-.
bool compares(const Axis& axis);
/// Steps in `direction` until a comparison may change (>= 1); counters wrap at 32 bits.
std::int64_t steps_to_comparison(const Axis& axis, std::int32_t counter, int direction);

}  // namespace motionrack::mcx314
