#include <fmt/format.h>

#include <motionrack/control/gcode/block.hpp>
#include <motionrack/control/gcode/empty_program.hpp>
#include <motionrack/control/gcode/language/oword.hpp>
#include <motionrack/control/gcode/program_lines.hpp>

namespace motionrack::control::gcode {

bool is_empty_program(std::string_view text) {
    ProgramLines lines(text);
    ProgramEndDetector end(false);
    for (std::string_view line; lines.next(line);) {
        if (end.is_at(line)) return true;
        if (is_rest_empty(line, 0)) continue;
        const std::size_t first = line.find('%');  // optional '%' at the start of the program
        if (first == std::string_view::npos || !is_rest_empty(line.substr(0, first), 0) ||
            !is_rest_empty(line, first + 1))
            return false;
    }
    return true;
}

Problem empty_program_problem(std::string_view text, const std::string& file) {
    ProgramLines lines(text);
    for (std::string_view line; lines.next(line);) continue;
    Problem problem;
    set_problem(problem, {}, 0, GrblStatus::unsupported,
                lines.number() == 0
                    ? "the program is empty: the file has no lines; is it the right one, and complete?"
                    : fmt::format("the program is empty: its {} {} nothing but comments and blanks; is it the right "
                                  "file, and complete?",
                                  lines.number() == 1 ? "only line" : fmt::format("{} lines", lines.number()),
                                  lines.number() == 1 ? "has" : "have"));
    problem.location.line = 1;
    problem.file = file;
    return problem;
}

}  // namespace motionrack::control::gcode
