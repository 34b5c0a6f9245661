// Budget of the moves that a program may make. It detects drilling cycles in a loop that never ends.
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <string_view>

namespace motionrack::control::gcode {

/// Compares the number of calls with the budget: 16 for each line, plus `max_steps`.
class StepBudget {
  public:
    /// `max_steps`: see Settings::max_steps.
    explicit StepBudget(std::int64_t max_steps) : max_steps_(max_steps) {}

    /// Counts a line of `program_flow`; call before it is read. `further_steps`: calls so far, without the first one of
    /// each line. Errors: too many calls; the program ends there.
    Outcome<void> take_line(std::string_view text, std::int64_t further_steps, ProgramFlow& program_flow);

  private:
    std::int64_t max_steps_;
    std::int64_t lines_ = 0;
};

}  // namespace motionrack::control::gcode
