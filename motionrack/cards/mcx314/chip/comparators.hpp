// Comparisons of LP or EP with COMP+ and COMP-.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/action_conditions.hpp>
#include <motionrack/cards/mcx314/chip/encoder_inputs.hpp>
#include <motionrack/cards/mcx314/chip/options.hpp>
#include <motionrack/cards/mcx314/chip/state.hpp>

namespace motionrack::mcx314 {

/// Returns true if interrupts, software limits or outputs depend on the comparisons with COMP+ and COMP-.
bool compares(const Axis& axis);
/// Returns the number of steps (>= 1) of `counter` in `direction` (+1, -1) until a comparison may change; counters wrap
/// at 32 bits.
std::int64_t steps_to_comparison(const Axis& axis, std::int32_t counter, int direction);

class Comparators {
  public:
    Comparators(State& state, const EncoderInputs& encoders, ActionConditions& conditions, const ChipOptions& options)
        : state_(state),
          encoders_(encoders),
          conditions_(conditions),
          extended_(options.extended()),
          limit_begins_(options.software_limit == SoftwareLimit::at ? 1 : 0) {}

    /// Evaluates the comparisons of axis `a`. Those that have become true request interrupts and are conditions of
    /// actions.
    void compare(int a);
    /// Returns the counter, LP or EP, that is compared with COMP+ and COMP-.
    std::int32_t compared_counter(int a) const;
    bool beyond_software_limit(int a) const;

  private:
    State& state_;
    const EncoderInputs& encoders_;
    ActionConditions& conditions_;
    const bool extended_;
    const std::int64_t limit_begins_;  // 1: software limits begin at COMP+, not beyond
};

}  // namespace motionrack::mcx314
