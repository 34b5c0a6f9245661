#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/rack/programmed_path.hpp>

namespace motionrack::rack {

namespace {

/// A move begins while the end of the previous one is still being executed, if the corner tolerance allows it.
constexpr double overlap_mm = 10;

}  // namespace

void ProgrammedPath::add(const control::Move& move, const control::Point& start) {
    if (move.kind == control::MoveKind::dwell) return;
    Programmed one;
    one.index = move.index;
    one.tolerance_mm = move.path == control::PathControl::continuous ? move.tolerance_mm : 0;
    one.path = control::geometry_of(move, start);
    one.begins_mm = moves_.empty() ? 0 : moves_.back().begins_mm + moves_.back().length_mm;
    if (one.path.shape == control::PathShape::line || one.path.shape == control::PathShape::arc)
        one.length_mm = one.path.length;
    max_tolerance_mm_ = std::max(max_tolerance_mm_, one.tolerance_mm);
    moves_.push_back(one);
}

void ProgrammedPath::drop_before(std::int64_t first) {
    for (auto left = begin_of(first) - moves_.cbegin(); left > 0; --left) moves_.pop_front();
}

ProgrammedPath::Moves::const_iterator ProgrammedPath::begin_of(std::int64_t first) const {
    const auto move = std::lower_bound(moves_.begin(), moves_.end(), first,
                                       [](const Programmed& one, std::int64_t index) { return one.index < index; });
    if (moves_.empty()) return move;
    const double begins = move == moves_.end() ? moves_.back().begins_mm : move->begins_mm;
    auto before = std::upper_bound(moves_.begin(), move, begins - overlap_mm,
                                   [](double at, const Programmed& one) { return at < one.begins_mm; });
    return before == moves_.begin() ? before : std::prev(before);
}

/// Returns the move that contains the position `mm` after the start of this one, or at least the next move.
ProgrammedPath::Moves::const_iterator ProgrammedPath::skip(const Moves::const_iterator& move, double mm) const {
    const auto next = std::next(move);
    const auto behind = std::upper_bound(next, moves_.end(), move->begins_mm + mm,
                                         [](double at, const Programmed& one) { return at < one.begins_mm; });
    return std::max(next, std::prev(behind));
}

ProgramDistance ProgrammedPath::distance(const ProgramPart& part, double x, double y, double z) const {
    double nearest = std::numeric_limits<double>::infinity(), min_beside = nearest;
    ProgramDistance out;
    const auto reached = std::lower_bound(moves_.begin(), moves_.end(), std::max(part.first, part.furthest),
                                          [](const Programmed& one, std::int64_t index) { return one.index < index; });
    const double reach =
        reached == moves_.end() ? part.reach_mm : part.reach_mm + reached->begins_mm + reached->length_mm;
    for (auto move = begin_of(part.first); move != moves_.end();) {
        if (move > reached && (move->index > part.last || move->begins_mm > reach)) break;
        const double dx = x - move->path.start[0], dy = y - move->path.start[1], dz = z - move->path.start[2];
        const double from_start = std::sqrt(dx * dx + dy * dy + dz * dz);
        // Path points before this length is used up are farther away than `enough`.
        const double enough = std::max(nearest, min_beside + max_tolerance_mm_);
        if (from_start - move->length_mm > enough) {
            move = skip(move, from_start - enough);
            continue;
        }
        const double off = move->length_mm > 0 ? control::distance_to(move->path, x, y, z) : from_start;
        nearest = std::min(nearest, off);
        if (off - move->tolerance_mm < min_beside) {
            min_beside = off - move->tolerance_mm;
            out.judged_mm = off;
            out.tolerance_mm = move->tolerance_mm;
        }
        ++move;
    }
    if (std::isfinite(nearest)) out.mm = nearest;
    return out;
}

}  // namespace motionrack::rack
