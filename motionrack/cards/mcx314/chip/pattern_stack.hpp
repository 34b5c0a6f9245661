// Holds the words of a bit pattern: registers, stack and running word.
#pragma once

#include <cstdint>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/kernel.hpp>

namespace motionrack::mcx314 {

class PatternStack {
  public:
    PatternStack(Pattern& pattern, sim::Kernel& kernel, sim::DeviceId id)
        : pattern_(pattern), kernel_(kernel), id_(id) {}

    void reset() { pattern_ = {}; }
    /// Executes a command of the bit pattern, 36h .. 39h.
    void execute(int code);
    /// Removes the running word and all stacked words.
    void clear();
    /// Makes the oldest stacked word, if any, the running one; requires that all steps of the running word are made.
    /// `made`: basic pulses so far; `interrupts`: a stack with one word left requests an interrupt.
    void next_word(std::int64_t made, bool interrupts);

  private:
    void stack();

    Pattern& pattern_;
    sim::Kernel& kernel_;
    const sim::DeviceId id_;
};

}  // namespace motionrack::mcx314
