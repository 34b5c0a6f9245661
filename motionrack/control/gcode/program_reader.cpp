// Pulls the calls line by line.
#include <algorithm>
#include <motionrack/control/gcode/empty_program.hpp>
#include <motionrack/control/gcode/program_reader.hpp>

namespace motionrack::control::gcode {

ProgramReader::ProgramReader(std::string_view text, const Settings& settings, std::string file)
    : program_flow_(text, settings, std::move(file)), interpreter_(settings), budget_(settings.max_steps) {}

Outcome<const CanonCall*> ProgramReader::next_from_lines() {
    std::string_view text;
    while (program_flow_.next(text)) {
        if (auto taken = budget_.take_line(text, further_steps_, program_flow_); !taken)
            return tl::unexpected<Problem>(std::move(taken.error()));
        if (auto done = interpreter_.line(text, program_flow_.number(), Language::program); !done) {
            program_flow_.line_rejected(text, done.error());
            const std::size_t column = static_cast<std::size_t>(done.error().location.column);
            if (program_flow_.at_end() && done.error().word == "(" &&
                text.find(')', column) == std::string_view::npos) {
                done.error().message = "the text ends inside this comment; is the file complete?";
            }
            return tl::unexpected<Problem>(std::move(done.error()));
        }
        if (auto done = program_flow_.line_accepted(interpreter_); !done)
            return tl::unexpected<Problem>(std::move(done.error()));
        if (const CanonCall* step = interpreter_.pull()) return step;
    }
    if (program_flow_.has_faults()) return tl::unexpected<Problem>(program_flow_.take_fault());
    if (auto done = interpreter_.finish(); !done) {
        done.error().file = program_flow_.file();
        return tl::unexpected<Problem>(std::move(done.error()));
    }
    return interpreter_.pull();
}

namespace {

/// Number of repeated problems after which a check stops.
constexpr int max_repeated = 10'000;

/// Returns true if `one` was reported before: errors in a loop or a subprogram occur repeatedly.
bool is_known(const std::vector<Problem>& problems, const Problem& one) {
    return std::any_of(problems.begin(), problems.end(), [&](const Problem& other) {
        return other.location.line == one.location.line && other.location.column == one.location.column &&
               other.file == one.file;
    });
}

}  // namespace

ProgramCheck check_program(std::string_view text, const Settings& settings, std::size_t max_problems,
                           const std::string& file) {
    ProgramCheck check;
    check.min = check.max = settings.start;
    ProgramReader reader(text, settings, file);
    int repeated = 0;
    for (;;) {
        const auto step = reader.next();
        if (!step) {
            if (is_known(check.problems, step.error())) {
                if (++repeated < max_repeated) continue;
                check.more_problems = true;
                break;
            }
            check.problems.push_back(step.error());
            if (check.problems.size() < max_problems) continue;
            check.more_problems = true;
            break;
        }
        if (*step == nullptr) break;
        if ((*step)->kind != CanonCallKind::move) continue;
        const Move& move = (*step)->move;
        if (move.kind == MoveKind::dwell) {
            ++check.dwells;
            check.seconds_of_dwells += move.seconds;
            continue;
        }
        ++check.moves;
        for (int axis = 0; axis < axis_count; ++axis) {
            check.min[axis] = std::min(check.min[axis], move.end[axis]);
            check.max[axis] = std::max(check.max[axis], move.end[axis]);
        }
    }
    check.lines = reader.program_flow().highest_line();
    check.ended = reader.interpreter().modes().ended;
    if (check.problems.empty() && is_empty_program(text)) check.problems.push_back(empty_program_problem(text, file));
    return check;
}

}  // namespace motionrack::control::gcode
