// Reading a whole program: lines out of the text, one step after the other, in constant memory.
#pragma once

#include <motionrack/control/gcode/interpreter.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::control::gcode {

/// Cuts a text into lines at LF, CR LF or CR, and leaves out a byte order mark at the beginning.
class Lines {
  public:
    explicit Lines(std::string_view text);

    /// The next line, without its end; false: there is none. Of a line longer than `longest_line` only the first
    /// longest_line + 1 characters are given, and the rest is skipped at the next call.
    bool next(std::string_view& line);

    std::int32_t number() const { return number_; }  ///< of the line that next() gave, from 1
    bool at_end() const { return at_ == end_ && !skip_; }

  private:
    const char* at_;
    const char* end_;
    std::int32_t number_ = 0;
    bool skip_ = false;
};

/// Where a program is over: after M2 or M30, or at a lone '%' that is not its first line with anything on it.
class ProgramEnd {
  public:
    /// For each line that was read, in order: whether it was the last one.
    bool at(const Block& block);

  private:
    bool begun_ = false;
};

/// Pulls the steps of a program one by one:
///
///     Reader reader(text, settings, "part.ngc");
///     for (;;) {
///         auto step = reader.next();
///         if (!step) { report(step.error().text()); break; }
///         if (*step == nullptr) break;
///         if ((*step)->kind == StepKind::move) planner.push((*step)->move);
///     }
///
/// After a problem the line has had no effect, and next() goes on with the line after it. The program is over after M2
/// or M30, at the end of the text, or at a lone '%' that is not its first line with anything on it.
class Reader {
  public:
    /// `text` must stay where it is as long as the Reader and the texts of its steps are used.
    Reader(std::string_view text, const Settings& settings, std::string file = {});

    /// The next step, valid until the next call; null: the program is over.
    Outcome<const Step*> next() {
        if (const Step* step = interpreter_.pull()) return step;
        return next_from_lines();
    }

    const Interpreter& interpreter() const { return interpreter_; }
    /// See Interpreter::probed(); after the step that probes, before the next one.
    void probed(bool hit, const Point& at, const Point& stands) { interpreter_.probed(hit, at, stands); }
    std::int32_t line() const { return lines_.number(); }  ///< the line that the last step or problem is from

  private:
    Outcome<const Step*> next_from_lines();

    Lines lines_;
    Interpreter interpreter_;
    std::string file_;
    ProgramEnd end_;
    bool over_ = false;
};

/// What one pass over a program finds.
struct Check {
    std::vector<Problem> problems;  ///< in the order of the lines
    bool more_problems = false;     ///< the pass ended early because there were as many as asked for
    std::int64_t lines = 0;         ///< read
    std::int64_t moves = 0;         ///< traverses, feeds and arcs
    std::int64_t dwells = 0;
    bool ended = false;  ///< by M2 or M30
    Point least = {};    ///< of all ends, machine coordinates; the start counts
    Point greatest = {};
    double seconds_of_dwells = 0;
};

/// Reads a program to its end without keeping it, and collects up to `most_problems` (>= 1).
Check check_program(std::string_view text, const Settings& settings, std::size_t most_problems,
                    const std::string& file = {});

}  // namespace motionrack::control::gcode
