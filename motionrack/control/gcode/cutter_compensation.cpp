// Moves of the cutter centre.
#include <fmt/format.h>

#include <cmath>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/cutter_compensation.hpp>
#include <motionrack/control/gcode/plane_point.hpp>
#include <string>

namespace motionrack::control::gcode {

namespace {

constexpr double largest_cutter_mm = 1000;

}  // namespace

bool CutterCompensation::select() {
    const std::int16_t code = block().g[g_cutter];
    const std::size_t column = block().g_column[g_cutter];
    if (code == 400) {
        if (state().compensating_ && !end_waiting_path()) return false;
        next().cutter = CutterSide::off;
        return true;
    }
    if (next().cutter != CutterSide::off) {
        return fail_at(
            column, GrblStatus::unsupported,
            fmt::format("{}: cutter compensation is on already ({} of the contour); write G40 and a straight "
                        "move before it",
                        name_of_g(code), next().cutter == CutterSide::left ? "left" : "right"));
    }
    if (settings().point_to_point) {
        return fail_at(
            column, GrblStatus::unsupported,
            fmt::format("{}: the axes of this rack position one by one, so cutter compensation is not possible",
                        name_of_g(code)));
    }
    double diameter = 0;
    if (!diameter_of_words(diameter)) return false;
    const bool left = (code / 10 == 41) == (diameter >= 0);
    next().cutter = left ? CutterSide::left : CutterSide::right;
    next().cutter_radius_mm = std::fabs(diameter) / 2;
    return true;
}

/// Reads the D word in mm; a negative diameter swaps the side.
bool CutterCompensation::diameter_of_words(double& diameter) {
    const std::int16_t code = block().g[g_cutter];
    const std::size_t column = block().g_column[g_cutter];
    use(letter_bit('D'));
    if (code % 10 != 0) {
        if (!block().has('D')) {
            return fail_at(
                column, GrblStatus::word_missing,
                fmt::format("D word missing: {0} needs the cutter's diameter; write e.g. {0} D6", name_of_g(code)));
        }
        diameter = scaled('D');
    } else {
        if (tools().empty()) {
            return fail_at(
                column, GrblStatus::unsupported,
                fmt::format("{0}: the program has no tool table to take the diameter from; give the program one "
                            "(--tools FILE, tools= in Python), or write it out, e.g. {0}.1 D6",
                            name_of_g(code)));
        }
        if (block().has('D') && !need_integer('D', 0, largest_tool, "the number of a tool")) return false;
        const bool of_spindle = !block().has('D') || block()['D'] == 0;
        const std::int32_t number = of_spindle ? next().tool_loaded : static_cast<std::int32_t>(block()['D']);
        if (number <= 0) {
            return fail_at(
                column, GrblStatus::word_missing,
                fmt::format("{0}: no tool is in the spindle; write e.g. {0} D1, or T1 M6 before it", name_of_g(code)));
        }
        const Tool* tool = tool_of_table(number, 'D', g_cutter);
        if (!tool) return false;
        diameter = tool->diameter_mm;
    }
    if (std::fabs(diameter) <= largest_cutter_mm) return true;
    return fail_at(
        block().has('D') ? block().column[letter_index('D')] : column, GrblStatus::value_too_large,
        fmt::format("a cutter of {:.6g} mm: the largest diameter is {:.6g} mm", diameter, largest_cutter_mm));
}

bool CutterCompensation::allows() {
    const auto forbid = [&](std::size_t column, std::string_view what) {
        return fail_at(
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
        return fail_at(column_of(g_cutter), GrblStatus::unsupported,
                       fmt::format("the work system is rotated by {:.6g} degrees (G10 L2 R); cutter compensation is "
                                   "then possible in G17 only; write G17, or end the rotation",
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
bool CutterCompensation::end_waiting_path() {
    state().plan_.joins = true;
    state().plan_.last = state().path_;
    return trim(state().plan_.last, state().from_, state().path_.end) || gouges(state().line_);
}

bool CutterCompensation::gouges(std::int32_t line) {
    return fail_at(
        error_column(), GrblStatus::bad_target,
        fmt::format("the cutter (radius {:.6g} mm) would have to move backwards along the move of line {}, which is "
                    "too short between its neighbours: it would cut into the contour; take a smaller cutter or "
                    "leave the move out",
                    modes().cutter_radius_mm, line));
}

/// Computes the offset path of the move from StraightWords or ArcWords.
bool CutterCompensation::path_beside(PlanePoint from, PlanePoint to, CutterPath& path) {
    const Move& move = steps().moving().move;
    const double radius = next().cutter_radius_mm;
    const double offset = next().cutter == CutterSide::left ? radius : -radius;
    const PlanePoint centre = {move.centre_first, move.centre_second};
    const bool is_arc = move.kind == MoveKind::arc;
    if (!state().compensating_ && length({to.first - from.first, to.second - from.second}) <= radius) {
        return fail_at(
            error_column(), GrblStatus::bad_target,
            fmt::format("the first move with cutter compensation must be longer in its plane than the cutter's "
                        "radius of {:.6g} mm; begin farther away",
                        radius));
    }
    if (!is_arc) {
        path = state().compensating_ ? offset_line(from, to, offset) : lead_in_line(from, to, offset);
        return true;
    }
    if (state().compensating_ ? offset_arc(from, to, centre, move.turns, offset, path)
                              : lead_in_arc(from, to, centre, move.turns, offset, path))
        return true;
    const double arc_radius = length({from.first - centre.first, from.second - centre.second});
    return fail_at(
        error_column(), GrblStatus::bad_radius,
        arc_radius <= radius
            ? fmt::format("the cutter (radius {:.6g} mm) does not fit into this arc of radius {:.6g} mm; take a "
                          "smaller cutter",
                          radius, arc_radius)
            : std::string("no lead-in arc reaches the offset of this arc; begin with a straight move"));
}

bool CutterCompensation::compensate() {
    Move& move = steps().moving().move;
    const auto& axes = plane_axes[next().plane];
    const PlanePoint from = {travel().position()[axes[0]], travel().position()[axes[1]]};
    const PlanePoint to = {travel().end()[axes[0]], travel().end()[axes[1]]};
    if (move.kind != MoveKind::arc && from.first == to.first && from.second == to.second) {
        if (!state().compensating_) return !state().off_path_ || reaches_contour();
        move.end[axes[0]] = state().path_.end.first;
        move.end[axes[1]] = state().path_.end.second;
        return true;
    }
    CutterPath& path = state().plan_.path;
    if (!path_beside(from, to, path)) return false;
    state().plan_.begins = true;
    state().plan_.from = state().off_path_ ? PlanePoint{state().at_[axes[0]], state().at_[axes[1]]} : from;
    if (state().compensating_ && !join(from)) return false;
    move.end[axes[0]] = path.end.first;
    move.end[axes[1]] = path.end.second;
    move.centre_first = path.centre.first;
    move.centre_second = path.centre.second;
    if (path.arc && !arc_within_limits(path.start, path.end, path.centre, path.turns)) return off_limits();
    return (reach(axes[0], path.end.first, error_column()) && reach(axes[1], path.end.second, error_column())) ||
           off_limits();
}

bool CutterCompensation::off_limits() {
    in_.words.prefix_problem("at the offset contour of the cutter's centre: ");
    return false;
}

/// Joins the waiting move to the move of this line.
bool CutterCompensation::join(PlanePoint corner) {
    const auto& axes = plane_axes[next().plane];
    const double offset = next().cutter == CutterSide::left ? next().cutter_radius_mm : -next().cutter_radius_mm;
    const CutterPath& path = state().plan_.path;
    const CornerJoinPoint junction = join_corner(state().path_, path, corner, offset);
    if (junction.kind == CornerJoin::none) {
        return fail_at(
            error_column(), GrblStatus::bad_target,
            fmt::format("the cutter (radius {:.6g} mm) does not fit into the corner between line {} and this one; "
                        "take a smaller cutter",
                        next().cutter_radius_mm, state().line_));
    }
    state().plan_.joins = true;
    state().plan_.last = state().path_;
    if (!trim(state().plan_.last, state().from_, junction.at)) return gouges(state().line_);
    if (!reach(axes[0], junction.at.first, error_column()) || !reach(axes[1], junction.at.second, error_column()))
        return off_limits();
    state().plan_.around = junction.kind == CornerJoin::around;
    state().plan_.from = state().plan_.around ? path.start : junction.at;
    if (!state().plan_.around) return true;
    // Before a rapid the corner is connected straight, above the workpiece.
    Move& arc = state().plan_.arc;
    arc = steps().moving().move;
    if (arc.kind != MoveKind::rapid) arc.kind = MoveKind::arc;
    arc.first = axes[0];
    arc.second = axes[1];
    arc.turns = offset > 0 ? -1 : 1;
    arc.centre_first = corner.first;
    arc.centre_second = corner.second;
    arc.end = travel().position();
    arc.end[axes[0]] = path.start.first;
    arc.end[axes[1]] = path.start.second;
    if (arc.kind == MoveKind::arc && !arc_within_limits(state().path_.end, path.start, corner, arc.turns))
        return off_limits();
    return (reach(axes[0], path.start.first, error_column()) && reach(axes[1], path.start.second, error_column())) ||
           off_limits();
}

bool CutterCompensation::end_program() {
    if (state().plan_.begins)
        return trim(state().plan_.path, state().plan_.from, state().plan_.path.end) || gouges(line_number());
    return !state().compensating_ || end_waiting_path();
}

bool CutterCompensation::may_wait() {
    const bool adds = !steps().has_only(StepQueue::todo_comments);
    if (!adds || state().plan_.begins || next().cutter == CutterSide::off || steps().ends_program()) return true;
    return fail_at(
        0, GrblStatus::unsupported,
        fmt::format(
            "{} steps already wait for the contour move after line {}, which is the limit; the line was not executed; "
            "write that move before it, or G40",
            CompensationQueue::max_steps, state().line_));
}

void CutterCompensation::commit() {
    const auto& axes = plane_axes[modes().plane];
    const bool off = modes().cutter == CutterSide::off;
    const bool ends = steps().is_end_pending() || off;
    const bool moved = steps().has(StepQueue::todo_motion);
    if (ends && state().compensating_ && !state().plan_.begins)
        state().held_.settle(axes[0], axes[1], state().plan_.last);
    if (!ends || state().plan_.begins) hold_steps();
    if (state().plan_.begins) {
        state().path_ = state().plan_.path;
        state().from_ = state().plan_.from;
        state().line_ = line_number();
        if (ends) state().held_.settle(axes[0], axes[1], state().path_);
    }
    if (state().compensating_ || state().plan_.begins) {
        state().at_ = travel().position();
        state().at_[axes[0]] = state().path_.end.first;
        state().at_[axes[1]] = state().path_.end.second;
        state().off_path_ = !(off && moved);
    } else {
        state().off_path_ = state().off_path_ && !moved;
    }
    state().compensating_ = (state().compensating_ || state().plan_.begins) && !ends;
    if (state().held_.has_ready()) steps().add(StepQueue::todo_held);
}

/// Completes the waiting calls up to the start of this line's move.
void CutterCompensation::settle_junction() {
    const auto& axes = plane_axes[modes().plane];
    if (state().plan_.joins) state().held_.settle(axes[0], axes[1], state().plan_.last);
    if (state().plan_.around) {
        CanonCall around;
        around.line = line_number();
        around.move = state().plan_.arc;
        state().held_.push(around);
    }
    state().held_.settle();
}

/// Queues the events and motion of this line; comments are passed on at once, the end of the program is last.
void CutterCompensation::hold_steps() {
    const std::uint32_t kept = steps().set_aside();
    while (!steps().empty()) {
        if (steps().is_motion_next() && state().plan_.begins) settle_junction();
        state().held_.push(*in_.pull());
    }
    steps().add(kept);
    if (!state().compensating_ && !state().plan_.begins) state().held_.settle();
}

void CutterCompensation::resync_position(const Point& position) {
    travel().move_to(position);
    state().held_.clear();
    state().compensating_ = state().off_path_ = false;
    in_.modes.switch_cutter_off();
}

Outcome<void> CutterCompensation::finish() {
    steps().clear();
    state().plan_.clear();
    if (!state().compensating_) return {};
    const auto& axes = plane_axes[modes().plane];
    if (!end_waiting_path()) {
        state().held_.settle(axes[0], axes[1], state().path_);
        state().held_.clear();
        resync_position(state().at_);
        return in_.words.problem_of_earlier(state().line_);
    }
    state().held_.settle(axes[0], axes[1], state().plan_.last);
    state().compensating_ = false;
    in_.modes.switch_cutter_off();
    steps().add(StepQueue::todo_held);
    return {};
}

}  // namespace motionrack::control::gcode
