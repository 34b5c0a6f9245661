// Moves that a contour may have.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/language/contour_reader.hpp>
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

std::optional<std::string> ContourReader::add(Interpreter& interpreter, std::int32_t line) {
    while (const CanonCall* step = interpreter.pull()) {
        const Move& move = step->move;
        if (step->kind != CanonCallKind::move || move.kind == MoveKind::dwell) continue;
        if (contour_.size() >= max_pieces)
            return fmt::format("a contour has at most {} moves; this is one more", max_pieces);
        const bool arc = move.kind == MoveKind::arc;
        if (arc && (move.first != 2 || std::abs(move.turns) != 1))
            return "a contour has arcs of less than a turn in the plane of X and Z (G18)";
        if (!begun_ && arc)
            return "the first move of a contour must be a straight move to its start, but this one is an arc";
        if (begun_ && move.end[1] != at_[1]) return "a contour is in X and Z only; leave Y out";
        const Point from = at_;
        at_ = move.end;
        ContourSegment piece;
        piece.line = line;
        piece.from = plane_of(from);
        piece.to = plane_of(at_);
        piece.turns = arc ? move.turns : 0;
        piece.centre = {move.centre_first, move.centre_second};
        const Block& block = interpreter.block();
        const double unit = interpreter.modes().inch ? 25.4 : 1;
        piece.chamfer = block.has('C');
        if (block.has('A') || block.has('C')) piece.corner = block[piece.chamfer ? 'C' : 'A'] * unit;
        if (piece.corner < 0 || (block.has('A') && block.has('C')))
            return "A is the radius of a fillet and C of a chamfer at the end of the move; write one of them, 0 or "
                   "more";
        if (!begun_ && piece.corner > 0)
            return "A and C make corners of a contour; its first move leads to its start, which has none";
        if (begun_ && (arc || length(piece.to - piece.from) > min_move_mm)) contour_.push_back(piece);
        begun_ = true;
    }
    return std::nullopt;
}

}  // namespace motionrack::control::gcode
