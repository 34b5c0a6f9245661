// Reads a whole program from its text, one canonical call at a time, in constant memory.
#pragma once

#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <motionrack/control/gcode/step_budget.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::control::gcode {

/// Pulls the canonical calls of a program one by one:
///
///     ProgramReader reader(text, settings, "part.ngc");
///     for (;;) {
///         auto step = reader.next();
///         if (!step) { report(step.error().text()); break; }
///         if (*step == nullptr) break;
///         if ((*step)->kind == CanonCallKind::move) planner.push((*step)->move);
///     }
///
/// A line with an error has no effect, and next() continues with the line after it. See ProgramFlow for O words and for
/// the end of the program.
class ProgramReader {
  public:
    /// `text` must stay valid while the ProgramReader and the texts of its calls are used.
    ProgramReader(std::string_view text, const Settings& settings, std::string file = {});

    /// Returns the next call, valid until the following next(); null at the end of the program.
    Outcome<const CanonCall*> next() {
        if (const CanonCall* step = interpreter_.pull()) {
            ++further_steps_;
            return step;
        }
        return next_from_lines();
    }

    const Interpreter& interpreter() const { return interpreter_; }
    const ProgramFlow& program_flow() const { return program_flow_; }
    /// Stores the result of a probing call before next() is called again; see Interpreter::set_probe_result().
    void set_probe_result(bool hit, const Point& at, const Point& stopped_at) {
        interpreter_.set_probe_result(hit, at, stopped_at);
    }
    std::int32_t line() const { return program_flow_.number(); }  ///< line of the last call or error

  private:
    Outcome<const CanonCall*> next_from_lines();

    ProgramFlow program_flow_;
    Interpreter interpreter_;
    StepBudget budget_;
    std::int64_t further_steps_ = 0;  ///< calls other than the first one of each line
};

/// Errors and totals found by reading a program once.
struct ProgramCheck {
    std::vector<Problem> problems;  ///< in line order
    bool more_problems = false;     ///< stopped early at the requested number of problems
    std::int64_t lines = 0;         ///< number of lines read
    std::int64_t moves = 0;         ///< number of rapids, feed moves and arcs
    std::int64_t dwells = 0;
    bool ended = false;  ///< the program ended with M2 or M30
    Point min = {};      ///< smallest machine coordinates of the start and all targets
    Point max = {};
    double seconds_of_dwells = 0;
};

/// Reads a program to its end without storing it, and collects up to `max_problems` errors (>= 1).
ProgramCheck check_program(std::string_view text, const Settings& settings, std::size_t max_problems,
                           const std::string& file = {});

}  // namespace motionrack::control::gcode
