// libFuzzer: any bytes as a G-code program; the reader rejects it with a position in the text or gives moves within the
// limits, for the whole language. Also feeds the same bytes as lines of a sender.
#include <cmath>
#include <cstdint>
#include <motionrack/control/gcode/canon.hpp>
#include <string_view>
#include <tests/fuzz/require.hpp>

namespace {

using namespace motionrack::control;
using namespace motionrack::control::gcode;
using motionrack::fuzz::require;

Settings machine(std::uint8_t choice) {
    Settings settings;
    for (int axis = 0; axis < axis_count; ++axis) {
        settings.limits[axis].present = axis < 3 || (choice & 1) != 0;
        settings.limits[axis].min_position = -400;
        settings.limits[axis].max_position = 600;
        settings.work_offsets[1][axis] = 12.5;
        settings.g30[axis] = -7;
    }
    settings.block_delete = (choice & 2) != 0;
    settings.start_in_g0 = (choice & 4) != 0;
    settings.probe = (choice & 16) == 0;
    settings.max_lines = 2'000;
    settings.tools = *read_tool_table("T1 Z10 D3\nT2 P7 X1 Z20 D6\nT3 D-4\n");
    if ((choice & 8) != 0)
        settings.subprogram = [](const std::string& name) -> motionrack::Result<std::string> {
            return "o<" + name + "> sub\nG0 X#1\no<" + name + "> endsub [#1]\n";
        };
    return settings;
}

void check_point(const Point& point) {
    for (const double value : point)
        require(value >= -400 - limit_slack && value <= 600 + limit_slack, "a place is within the limits");
}

void check_move(const Move& move, std::int32_t line) {
    require(move.line == line && line >= 1, "a move has its line");
    check_point(move.end);
    require(std::isfinite(move.feed) && move.feed >= 0 && std::isfinite(move.tolerance_mm) && move.tolerance_mm >= 0,
            "feed and tolerance are numbers");
    require(std::isfinite(move.seconds) && move.seconds >= 0, "a dwell takes some time");
    if (move.kind == MoveKind::feed || move.kind == MoveKind::arc) require(move.feed > 0, "a cut has a feed");
    if (move.kind != MoveKind::arc) return;
    require(move.turns != 0 && move.first < 3 && move.second < 3 && move.first != move.second, "an arc is in a plane");
    const double radius =
        std::hypot(move.end[move.first] - move.centre_first, move.end[move.second] - move.centre_second);
    require(std::isfinite(radius) && radius > 0, "an arc has a radius");
}

void check_problem(const Problem& problem, std::string_view text) {
    require(!problem.message.empty() && problem.status != GrblStatus::none, "a problem has a sentence and a number");
    require(problem.location.line >= 1 && problem.location.column >= 1, "a problem has a place", problem.message);
    if (problem.file != "f") return;
    ProgramLines lines(text);
    std::string_view line;
    while (lines.number() < problem.location.line) require(lines.next(line), "a problem's line is in the text");
    require(static_cast<std::size_t>(problem.location.column) <= line.size() + 1, "a problem's column is in its line");
    require(problem.word.empty() ||
                line.substr(static_cast<std::size_t>(problem.location.column - 1)).starts_with(problem.word),
            "a problem's word is at its place", problem.word);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    ProgramReader reader(text, machine(data[0]), "f");
    Point before = {};
    int steps = 0;
    int problems = 0;
    while (++steps < 20'000 && problems < 50) {
        const auto step = reader.next();
        if (!step) {
            ++problems;
            check_problem(step.error(), text);
            continue;
        }
        if (*step == nullptr) break;
        if ((*step)->kind == CanonCallKind::move) {
            check_move((*step)->move, (*step)->line);
            before = (*step)->move.end;
        }
    }
    check_point(reader.interpreter().position());
    Interpreter sender(machine(data[0]));
    ProgramLines lines(text);
    for (std::string_view line; lines.next(line);) {
        if (const auto read = sender.line(line, lines.number(), Language::words); !read)
            require(read.error().status != GrblStatus::none, "a refused line has a number");
        require(!sender.block().has_o_word && sender.block().assignments.empty(), "a sender's line has no flow");
    }
    if (steps < 20'000 && problems == 0) {
        require(before == reader.interpreter().position(), "the reader is where the last move ends");
        const auto printed = print_canon(text, machine(data[0]), {}, [](std::string_view) {});
        require(printed.has_value(), "a program that is read is printed");
    }
    return 0;
}
