// Compares the calls of a program with its lines.
#include <fmt/format.h>

#include <motionrack/control/gcode/step_budget.hpp>
#include <utility>

namespace motionrack::control::gcode {

/// Checks the budget of cycles; calls of other lines are covered by the allowance for each line.
Outcome<void> StepBudget::take_line(std::string_view text, std::int64_t further_steps, ProgramFlow& program_flow) {
    constexpr std::int64_t steps_of_a_line = 16;
    ++lines_;
    if (further_steps <= max_steps_ + steps_of_a_line * lines_) return {};
    Problem problem;
    set_problem(
        problem, text, 0, GrblStatus::unsupported,
        fmt::format("the lines up to here have made {} moves, most of them of drilling cycles, without an end of "
                    "the program; check that its loops end. The rest was not read",
                    further_steps));
    program_flow.line_rejected(text, problem);
    program_flow.end();
    return tl::unexpected<Problem>(std::move(problem));
}

}  // namespace motionrack::control::gcode
