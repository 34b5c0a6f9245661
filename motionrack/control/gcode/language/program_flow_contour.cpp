// Reads the contour of a lathe cycle: the moves of a sub, which are not executed.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/language/program_flow.hpp>
#include <motionrack/control/gcode/plane_point.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr std::size_t max_pieces = 10'000;
/// Shorter moves are skipped, mm.
constexpr double min_move_mm = 1e-6;

PlanePoint plane_of(const Point& at) {
    return {at[2], at[0]};
}

}  // namespace

Outcome<void> ProgramFlow::follow_contour(Interpreter& interpreter) {
    const Block& block = interpreter.block();
    const OWordLocation here = this_line(block, block.g_column[g_motion]);
    const auto failed = [&]() -> Outcome<void> { return tl::unexpected<Problem>(problem_); };
    if (!source_->index && !make_index(*source_)) return tl::unexpected<Problem>(take_fault());
    Target target{};
    if (!within_budget(here) || !find_sub(here, interpreter.contour_label(), false, target)) return failed();
    Interpreter reader = interpreter.contour_interpreter();
    if (!reader.parameters().enter({})) {
        fail(here, here.column,
             fmt::format("{} is nested in {} calls; check that the sub does not call itself endlessly",
                         name_of_g(block.g[g_motion]), max_call_depth));
        return failed();
    }
    std::vector<ContourSegment> contour;
    const std::size_t depth = frames_.size();
    enter(target, no_location, 0);
    const bool good = read_contour(reader, contour);
    while (frames_.size() > depth) back_to_caller();
    over_ = !faults_.empty();
    if (!good) return failed();
    if (contour.empty()) {
        fail(here, here.column,
             fmt::format("{}: o{} sub has no contour; it needs a straight move to the start of the contour, and one or "
                         "more after it",
                         name_of_g(block.g[g_motion]), interpreter.contour_label()));
        return failed();
    }
    if (auto turned = interpreter.turn(std::move(contour)); !turned) {
        location(turned.error());
        return turned;
    }
    return {};
}

/// Executes the sub with a separate interpreter.
bool ProgramFlow::read_contour(Interpreter& reader, std::vector<ContourSegment>& contour) {
    const std::size_t depth = frames_.size();
    Point at = {};
    bool begun = false;
    for (std::string_view line; frames_.size() >= depth && next(line);) {
        if (auto done = reader.line(line, lines_.number(), Language::program); !done) {
            problem_ = done.error();
            location(problem_);
            return false;
        }
        const Block& block = reader.block();
        const OWordLocation here = this_line(block, 0);
        if (reader.is_lathe_cycle())
            return fail(here, block.g_column[g_motion],
                        fmt::format("{} stands within the contour of another cycle; end that first",
                                    name_of_g(block.g[g_motion])));
        if (auto taken = line_accepted(reader); !taken) {
            problem_ = taken.error();
            return false;
        }
        if (!add_contour(reader, here, contour, at, begun)) return false;
    }
    return true;
}

/// Adds the moves of the last line; the first move leads to the beginning of the contour.
bool ProgramFlow::add_contour(Interpreter& reader, const OWordLocation& here, std::vector<ContourSegment>& contour,
                              Point& at, bool& begun) {
    while (const CanonCall* step = reader.pull()) {
        const Move& move = step->move;
        if (step->kind != CanonCallKind::move || move.kind == MoveKind::dwell) continue;
        if (contour.size() >= max_pieces)
            return fail(here, 0, fmt::format("a contour has at most {} moves; this is one more", max_pieces));
        const bool arc = move.kind == MoveKind::arc;
        if (arc && (move.first != 2 || std::abs(move.turns) != 1))
            return fail(here, 0, "a contour has arcs of less than a turn in the plane of X and Z (G18)");
        if (!begun && arc)
            return fail(here, 0,
                        "the first move of a contour must be a straight move to its start, but this one is an arc");
        if (begun && move.end[1] != at[1]) return fail(here, 0, "a contour is in X and Z only; leave Y out");
        const Point from = at;
        at = move.end;
        ContourSegment piece;
        piece.line = here.line;
        piece.from = plane_of(from);
        piece.to = plane_of(at);
        piece.turns = arc ? move.turns : 0;
        piece.centre = {move.centre_first, move.centre_second};
        const Block& block = reader.block();
        const double unit = reader.modes().inch ? 25.4 : 1;
        piece.chamfer = block.has('C');
        if (block.has('A') || block.has('C')) piece.corner = block[piece.chamfer ? 'C' : 'A'] * unit;
        if (piece.corner < 0 || (block.has('A') && block.has('C')))
            return fail(
                here, 0,
                "A is the radius of a fillet and C of a chamfer at the end of the move; write one of them, 0 or more");
        if (!begun && piece.corner > 0)
            return fail(here, 0,
                        "A and C make corners of a contour; its first move leads to its start, which has none");
        if (begun && (arc || length(piece.to - piece.from) > min_move_mm)) contour.push_back(piece);
        begun = true;
    }
    return true;
}

}  // namespace motionrack::control::gcode
