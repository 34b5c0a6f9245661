// G40, G41, G42, G41.1, G42.1: converts the moves of a line to moves of the cutter centre; checks for conflicts.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/plane_point.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr double largest_cutter_mm = 1000;

}  // namespace

/// G40 .. G42.1.
bool Interpreter::cutter() {
    const std::int16_t code = block().g[g_cutter];
    const std::size_t column = block().g_column[g_cutter];
    if (code == 400) {
        if (compensating_ && !end_waiting_path()) return false;
        next().cutter = CutterSide::off;
        return true;
    }
    if (next().cutter != CutterSide::off) {
        return words_.fail_at(
            column, GrblStatus::unsupported,
            fmt::format("{}: cutter compensation is on already ({} of the contour); write G40 and a straight "
                        "move before it",
                        name_of_g(code), next().cutter == CutterSide::left ? "left" : "right"));
    }
    if (settings_.point_to_point) {
        return words_.fail_at(
            column, GrblStatus::unsupported,
            fmt::format("{}: the axes of this rack position one by one, so cutter compensation is not possible",
                        name_of_g(code)));
    }
    double diameter = 0;
    if (!cutter_diameter(diameter)) return false;
    const bool left = (code / 10 == 41) == (diameter >= 0);
    next().cutter = left ? CutterSide::left : CutterSide::right;
    next().cutter_radius_mm = std::fabs(diameter) / 2;
    return true;
}

/// Reads the D word in mm; a negative diameter swaps the side.
bool Interpreter::cutter_diameter(double& diameter) {
    const std::int16_t code = block().g[g_cutter];
    const std::size_t column = block().g_column[g_cutter];
    words_.use(letter_bit('D'));
    if (code % 10 != 0) {
        if (!block().has('D')) {
            return words_.fail_at(
                column, GrblStatus::word_missing,
                fmt::format("D word missing: {0} needs the cutter's diameter; write e.g. {0} D6", name_of_g(code)));
        }
        diameter = scaled('D');
    } else {
        if (tools().empty()) {
            return words_.fail_at(
                column, GrblStatus::unsupported,
                fmt::format("{0}: the program has no tool table to take the diameter from; give the program one "
                            "(--tools FILE, tools= in Python), or write it out, e.g. {0}.1 D6",
                            name_of_g(code)));
        }
        if (block().has('D') && !words_.need_integer('D', 0, largest_tool, "the number of a tool")) return false;
        const bool of_spindle = !block().has('D') || block()['D'] == 0;
        const std::int32_t number = of_spindle ? next().tool_loaded : static_cast<std::int32_t>(block()['D']);
        if (number <= 0) {
            return words_.fail_at(
                column, GrblStatus::word_missing,
                fmt::format("{0}: no tool is in the spindle; write e.g. {0} D1, or T1 M6 before it", name_of_g(code)));
        }
        const Tool* tool = tool_of_table(number, 'D', g_cutter);
        if (!tool) return false;
        diameter = tool->diameter_mm;
    }
    if (std::fabs(diameter) <= largest_cutter_mm) return true;
    return words_.fail_at(
        block().has('D') ? block().column[letter_index('D')] : column, GrblStatus::value_too_large,
        fmt::format("a cutter of {:.6g} mm: the largest diameter is {:.6g} mm", diameter, largest_cutter_mm));
}

/// Checks for changes that compensation does not allow.
bool Interpreter::cutter_allows() {
    const auto forbid = [&](std::size_t column, std::string_view what) {
        return words_.fail_at(
            column, GrblStatus::axis_conflict,
            fmt::format("{} while cutter compensation is on; write G40 and a straight move before it", what));
    };
    const bool was_on = modes().cutter != CutterSide::off;
    // M72 restores modes, too.
    const auto column_of = [&](GroupG group) -> std::size_t {
        return block().has_g(group)      ? block().g_column[group]
               : block().has_m(m_state)  ? block().m_column[m_state]
               : block().has_g(g_cutter) ? block().g_column[g_cutter]
                                         : 0;
    };
    if (was_on && next().plane != modes().plane) return forbid(column_of(g_plane), "the plane cannot change");
    if (was_on && next().inch != modes().inch) return forbid(column_of(g_units), "the units cannot change");
    if (was_on && next().system != modes().system) return forbid(column_of(g_system), "the work offset cannot change");
    if (frame_now().is_rotated && next().plane != 0) {
        return words_.fail_at(
            column_of(g_cutter), GrblStatus::unsupported,
            fmt::format("the work system is turned by {:.6g} degrees (G10 L2 R), where cutter compensation "
                        "is possible in G17 only",
                        frame_now().rotation_deg[next().system]));
    }
    if (was_on && block().has_g(g_tool_length) && frame_now().tool != frame().tool)
        return forbid(block().g_column[g_tool_length], "the tool length cannot change");
    if (next().inverse_time) {
        return forbid(column_of(g_feed_mode), "G93 (inverse time) cannot be used");
    }
    if (was_on && block().has_m(m_tool))
        return forbid(block().m_column[m_tool],
                      block().m[m_tool] == 61 ? "M61 cannot set another tool" : "M6 cannot change the tool");
    const std::int16_t once = block().has_g(g_nonmodal) ? block().g[g_nonmodal] : std::int16_t{40};
    if (once == 40) return true;
    return forbid(block().g_column[g_nonmodal], fmt::format("{} cannot be done", name_of_g(once)));
}

/// Ends the waiting move, the last compensated one, without a corner.
bool Interpreter::end_waiting_path() {
    cutter_plan_.joins = true;
    cutter_plan_.last = cutter_path_;
    return trim(cutter_plan_.last, cutter_from_, cutter_path_.end) || gouges(cutter_line_);
}

bool Interpreter::gouges(std::int32_t line) {
    return words_.fail_at(
        words_.error_column(), GrblStatus::bad_target,
        fmt::format("the cutter (radius {:.6g} mm) would have to move backwards along the move of line {}, which is "
                    "too short between its neighbours: it would cut into the contour; take a smaller cutter or "
                    "leave the move out",
                    modes().cutter_radius_mm, line));
}

/// Computes the offset path of the move from straight() or arc().
bool Interpreter::path_beside(PlanePoint from, PlanePoint to, CutterPath& path) {
    const Move& move = steps_.moving().move;
    const double radius = next().cutter_radius_mm;
    const double offset = next().cutter == CutterSide::left ? radius : -radius;
    const PlanePoint centre = {move.centre_first, move.centre_second};
    const bool is_arc = move.kind == MoveKind::arc;
    if (!compensating_ && length({to.first - from.first, to.second - from.second}) <= radius) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::bad_target,
            fmt::format("the first move with cutter compensation must be longer in its plane than the cutter's "
                        "radius of {:.6g} mm; begin farther away",
                        radius));
    }
    if (!is_arc) {
        path = compensating_ ? offset_line(from, to, offset) : lead_in_line(from, to, offset);
        return true;
    }
    if (compensating_ ? offset_arc(from, to, centre, move.turns, offset, path)
                      : lead_in_arc(from, to, centre, move.turns, offset, path))
        return true;
    const double arc_radius = length({from.first - centre.first, from.second - centre.second});
    return words_.fail_at(
        words_.error_column(), GrblStatus::bad_radius,
        arc_radius <= radius
            ? fmt::format("the cutter (radius {:.6g} mm) does not fit into this arc of radius {:.6g} mm; take a "
                          "smaller cutter",
                          radius, arc_radius)
            : std::string("no lead-in arc reaches the offset of this arc; begin with a straight move"));
}

/// Converts the programmed move to that of the cutter, which waits until the next one is known.
bool Interpreter::compensate() {
    Move& move = steps_.moving().move;
    const auto& axes = plane_axes[next().plane];
    const PlanePoint from = {travel_.position()[axes[0]], travel_.position()[axes[1]]};
    const PlanePoint to = {travel_.end()[axes[0]], travel_.end()[axes[1]]};
    if (move.kind != MoveKind::arc && from.first == to.first && from.second == to.second) {
        if (!compensating_) return !off_path_ || reaches_contour();
        move.end[axes[0]] = cutter_path_.end.first;
        move.end[axes[1]] = cutter_path_.end.second;
        return true;
    }
    CutterPath& path = cutter_plan_.path;
    if (!path_beside(from, to, path)) return false;
    cutter_plan_.begins = true;
    cutter_plan_.from = off_path_ ? PlanePoint{at_[axes[0]], at_[axes[1]]} : from;
    if (compensating_ && !join(from)) return false;
    move.end[axes[0]] = path.end.first;
    move.end[axes[1]] = path.end.second;
    move.centre_first = path.centre.first;
    move.centre_second = path.centre.second;
    if (path.arc && !arc_within_limits(path.start, path.end, path.centre, path.turns)) return off_limits();
    return (reach(axes[0], path.end.first, words_.error_column()) &&
            reach(axes[1], path.end.second, words_.error_column())) ||
           off_limits();
}

/// Checks the return from the offset path to the contour, which may be outside the limits.
bool Interpreter::reaches_contour() {
    for (int axis = 0; axis < 3; ++axis)
        if (travel_.end()[axis] != travel_.position()[axis] || travel_.end()[axis] != at_[axis])
            if (!reach(axis, travel_.end()[axis], words_.error_column())) return false;
    return true;
}

bool Interpreter::off_limits() {
    words_.prefix_problem("at the offset contour of the cutter's centre: ");
    return false;
}

/// Joins the waiting move to the move of this line.
bool Interpreter::join(PlanePoint corner) {
    const auto& axes = plane_axes[next().plane];
    const double offset = next().cutter == CutterSide::left ? next().cutter_radius_mm : -next().cutter_radius_mm;
    const CutterPath& path = cutter_plan_.path;
    const CornerJoinPoint junction = join_corner(cutter_path_, path, corner, offset);
    if (junction.kind == CornerJoin::none) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::bad_target,
            fmt::format("the cutter (radius {:.6g} mm) does not fit into the corner between line {} and this one; "
                        "take a smaller cutter",
                        next().cutter_radius_mm, cutter_line_));
    }
    cutter_plan_.joins = true;
    cutter_plan_.last = cutter_path_;
    if (!trim(cutter_plan_.last, cutter_from_, junction.at)) return gouges(cutter_line_);
    if (!reach(axes[0], junction.at.first, words_.error_column()) ||
        !reach(axes[1], junction.at.second, words_.error_column()))
        return off_limits();
    cutter_plan_.around = junction.kind == CornerJoin::around;
    cutter_plan_.from = cutter_plan_.around ? path.start : junction.at;
    if (!cutter_plan_.around) return true;
    // Before a rapid the corner is connected straight, above the workpiece.
    Move& arc = cutter_plan_.arc;
    arc = steps_.moving().move;
    if (arc.kind != MoveKind::rapid) arc.kind = MoveKind::arc;
    arc.first = axes[0];
    arc.second = axes[1];
    arc.turns = offset > 0 ? -1 : 1;
    arc.centre_first = corner.first;
    arc.centre_second = corner.second;
    arc.end = travel_.position();
    arc.end[axes[0]] = path.start.first;
    arc.end[axes[1]] = path.start.second;
    if (arc.kind == MoveKind::arc && !arc_within_limits(cutter_path_.end, path.start, corner, arc.turns))
        return off_limits();
    return (reach(axes[0], path.start.first, words_.error_column()) &&
            reach(axes[1], path.start.second, words_.error_column())) ||
           off_limits();
}

/// After G40 the cutter is still on the offset path.
bool Interpreter::leaves_straight(std::int16_t code) {
    if (!off_path_ || (compensating_ && next().cutter != CutterSide::off)) return true;
    return words_.fail_at(
        words_.error_column(), GrblStatus::bad_target,
        fmt::format("{} after G40: the cutter is still at the offset contour; leave it with a straight move",
                    name_of_g(code)));
}

/// Handles the end of the program on this line.
bool Interpreter::end_cutter() {
    if (cutter_plan_.begins)
        return trim(cutter_plan_.path, cutter_plan_.from, cutter_plan_.path.end) || gouges(words_.number());
    return !compensating_ || end_waiting_path();
}

/// Refuses a line whose calls would have to wait as well: it has no compensated move and does not end compensation.
bool Interpreter::may_wait() {
    const bool adds = !steps_.has_only(StepQueue::todo_comments);
    if (!adds || cutter_plan_.begins || next().cutter == CutterSide::off || steps_.ends_program()) return true;
    return words_.fail_at(
        0, GrblStatus::unsupported,
        fmt::format(
            "{} steps already wait for the contour move after line {}, which is the limit; the line was not executed; "
            "write that move before it, or G40",
            CompensationQueue::max_steps, cutter_line_));
}

/// Applies a valid line: final calls become ready, its own calls wait behind them.
void Interpreter::commit_cutter() {
    const auto& axes = plane_axes[modes().plane];
    const bool off = modes().cutter == CutterSide::off;
    const bool ends = steps_.is_end_pending() || off;
    const bool moved = steps_.has(StepQueue::todo_motion);
    if (ends && compensating_ && !cutter_plan_.begins) held_.settle(axes[0], axes[1], cutter_plan_.last);
    if (!ends || cutter_plan_.begins) hold_steps();
    if (cutter_plan_.begins) {
        cutter_path_ = cutter_plan_.path;
        cutter_from_ = cutter_plan_.from;
        cutter_line_ = words_.number();
        if (ends) held_.settle(axes[0], axes[1], cutter_path_);
    }
    if (compensating_ || cutter_plan_.begins) {
        at_ = travel_.position();
        at_[axes[0]] = cutter_path_.end.first;
        at_[axes[1]] = cutter_path_.end.second;
        off_path_ = !(off && moved);
    } else {
        off_path_ = off_path_ && !moved;
    }
    compensating_ = (compensating_ || cutter_plan_.begins) && !ends;
    if (held_.has_ready()) steps_.add(StepQueue::todo_held);
}

/// Completes the waiting calls up to the start of this line's move.
void Interpreter::settle_junction() {
    const auto& axes = plane_axes[modes().plane];
    if (cutter_plan_.joins) held_.settle(axes[0], axes[1], cutter_plan_.last);
    if (cutter_plan_.around) {
        CanonCall around;
        around.line = words_.number();
        around.move = cutter_plan_.arc;
        held_.push(around);
    }
    held_.settle();
}

/// Queues the events and motion of this line; comments are passed on at once, the end of the program is last.
void Interpreter::hold_steps() {
    const std::uint32_t kept = steps_.set_aside();
    while (!steps_.empty()) {
        if (steps_.is_motion_next() && cutter_plan_.begins) settle_junction();
        held_.push(*pull());
    }
    steps_.add(kept);
    if (!compensating_ && !cutter_plan_.begins) held_.settle();
}

void Interpreter::resync_position(const Point& position) {
    travel_.move_to(position);
    held_.clear();
    compensating_ = off_path_ = false;
    modes_.switch_cutter_off();
}

Outcome<void> Interpreter::finish() {
    steps_.clear();
    cutter_plan_.clear();
    if (!compensating_) return {};
    const auto& axes = plane_axes[modes().plane];
    if (!end_waiting_path()) {
        held_.settle(axes[0], axes[1], cutter_path_);
        held_.clear();
        resync_position(at_);
        return words_.problem_of_earlier(cutter_line_);
    }
    held_.settle(axes[0], axes[1], cutter_plan_.last);
    compensating_ = false;
    modes_.switch_cutter_off();
    steps_.add(StepQueue::todo_held);
    return {};
}

}  // namespace motionrack::control::gcode
