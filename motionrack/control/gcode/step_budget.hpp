// Budget of the moves that a program may make: loops of drilling cycles that never end are found by it.
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <string_view>

namespace motionrack::control::gcode {

/// Counts lines against the calls that they have made.
class StepBudget {
  public:
    /// See Settings::max_steps.
    explicit StepBudget(std::int64_t max_steps) : max_steps_(max_steps) {}

    /// Counts a line of `program_flow`; call before it is read. `further_steps`: calls so far, without the first one of
    /// each line. Errors: they are too many; the program ends there.
    Outcome<void> take_line(std::string_view text, std::int64_t further_steps, ProgramFlow& program_flow);

  private:
    std::int64_t max_steps_;
    std::int64_t lines_ = 0;
};

}  // namespace motionrack::control::gcode
