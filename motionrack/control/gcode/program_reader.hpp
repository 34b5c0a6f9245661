// Reading a whole program: lines out of the text, one step after the other, in constant memory.
#pragma once

#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::control::gcode {

/// Pulls the steps of a program one by one:
///
///     ProgramReader reader(text, settings, "part.ngc");
///     for (;;) {
///         auto step = reader.next();
///         if (!step) { report(step.error().text()); break; }
///         if (*step == nullptr) break;
///         if ((*step)->kind == CanonCallKind::move) planner.push((*step)->move);
///     }
///
/// After a problem the line has had no effect, and next() goes on with the line after it; see ProgramFlow for O words,
/// and for where the program is over.
class ProgramReader {
  public:
    /// `text` must stay where it is as long as the ProgramReader and the texts of its steps are used.
    ProgramReader(std::string_view text, const Settings& settings, std::string file = {});

    /// The next step, valid until the next call; null: the program is over.
    Outcome<const CanonCall*> next() {
        if (const CanonCall* step = interpreter_.pull()) {
            ++further_steps_;
            return step;
        }
        return next_from_lines();
    }

    const Interpreter& interpreter() const { return interpreter_; }
    const ProgramFlow& walk() const { return walk_; }
    /// See Interpreter::set_probe_result(); after the step that probes, before the next one.
    void set_probe_result(bool hit, const Point& at, const Point& stands) {
        interpreter_.set_probe_result(hit, at, stands);
    }
    std::int32_t line() const { return walk_.number(); }  ///< the line that the last step or problem is from

  private:
    Outcome<const CanonCall*> next_from_lines();
    bool within_budget() const;

    ProgramFlow walk_;
    Interpreter interpreter_;
    std::int64_t max_steps_;
    std::int64_t further_steps_ = 0;  ///< than the first ones of their lines
    std::int64_t lines_read_ = 0;
};

/// What one pass over a program finds.
struct ProgramCheck {
    std::vector<Problem> problems;  ///< in the order of the lines
    bool more_problems = false;     ///< the pass ended early because there were as many as asked for
    std::int64_t lines = 0;         ///< read
    std::int64_t moves = 0;         ///< traverses, feeds and arcs
    std::int64_t dwells = 0;
    bool ended = false;  ///< by M2 or M30
    Point min = {};      ///< of all ends, machine coordinates; the start counts
    Point max = {};
    double seconds_of_dwells = 0;
};

/// Reads a program to its end without keeping it, and collects up to `max_problems` (>= 1).
ProgramCheck check_program(std::string_view text, const Settings& settings, std::size_t max_problems,
                           const std::string& file = {});

}  // namespace motionrack::control::gcode
