// G5 and G5.1: from words to the four points of a cubic, checked against the limits.
#include <fmt/format.h>

#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>

namespace motionrack::control::gcode {

bool Interpreter::spline(std::int16_t code) {
    if (!spline_allowed(code) || !targets(false)) return false;
    const PlanePoint start = {travel_.position()[0], travel_.position()[1]};
    const PlanePoint end = {travel_.end()[0], travel_.end()[1]};
    CubicBezier curve;
    if (!(code == 50 ? cubic_of_words(start, end, curve) : quadratic_of_words(start, end, curve))) return false;
    if (curve.is_point()) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::bad_target,
            fmt::format("{}: the curve has no length; its end and control points are its start", name_of_g(code)));
    }
    for (const int axis : {0, 1}) {
        double min = 0, max = 0;
        curve.range(axis == 0 ? &PlanePoint::first : &PlanePoint::second, min, max);
        if (!reach(axis, min, words_.error_column()) || !reach(axis, max, words_.error_column())) {
            words_.prefix_problem("this curve exceeds the travel: ");
            return false;
        }
    }
    if (!feed_of(begin_move(MoveKind::arc))) return false;
    steps_.add_spline(curve);
    return true;
}

bool Interpreter::spline_allowed(std::int16_t code) {
    const std::string name = name_of_g(code);
    const auto refuse = [&](GrblStatus status, const std::string& why) {
        return words_.fail_at(words_.error_column(), status, name + why);
    };
    if (settings_.point_to_point)
        return refuse(GrblStatus::unsupported,
                      " is a curve, but the axes of this rack position one by one; write straight moves");
    if (next().cutter != CutterSide::off)
        return refuse(GrblStatus::axis_conflict,
                      " is not possible while cutter compensation is on; write G40 and a straight move before it");
    if (!leaves_straight(code)) return false;
    if (next().plane != 0) return refuse(GrblStatus::no_plane_axis, " is a curve in X and Y; write G17 before it");
    if (next().inverse_time)
        return refuse(GrblStatus::no_feed, " cannot be done in G93 (inverse time); write G94 and a feed before it");
    constexpr std::uint32_t in_plane = letter_bit('X') | letter_bit('Y');
    if ((block().words & in_plane) == 0) {
        return refuse(GrblStatus::no_plane_axis, code == 50 ? " needs its end; write e.g. G5 X20 Y0 I5 J10 P-5 Q10"
                                                            : " needs its end; write e.g. G5.1 X20 Y0 I10 J10");
    }
    for (const char letter : {'Z', 'A', 'B', 'C'}) {
        if (!block().has(letter)) continue;
        return words_.fail_word(letter, GrblStatus::unused_word,
                                fmt::format("{}: {} moves X and Y only; put the other axes on a separate line",
                                            words_.word_text(letter), name));
    }
    return true;
}

/// I J lead from the start to the first control point, P Q from the end to the second one.
bool Interpreter::cubic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve) {
    if (!block().has('P') || !block().has('Q') || (words_.used() & (letter_bit('P') | letter_bit('Q'))) != 0) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::word_missing,
            "G5 needs P and Q, the distance from its end to its second control point; write e.g. G5 X20 Y0 "
            "I5 J10 P-5 Q10");
    }
    if (block().has('I') != block().has('J')) {
        const char missing = block().has('I') ? 'J' : 'I';
        return words_.fail_at(
            words_.error_column(), GrblStatus::no_offsets,
            fmt::format(
                "{} word missing: G5 takes both I and J, or neither to continue in the direction of the G5 before it",
                missing));
    }
    PlanePoint handle = {-modes().spline_end.first,
                         -modes().spline_end.second};  // as written: not rotated with the work system
    const bool goes_on =
        modes().motion == 50 && modes().spline_at.first == start.first && modes().spline_at.second == start.second;
    if (block().has('I')) {
        handle = {scaled('I'), scaled('J')};
    } else if (!goes_on) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::no_offsets,
            "G5 needs I and J, the distance from its start to its first control point; only a G5 right "
            "after another may omit them");
    }
    words_.use(letter_bit('I') | letter_bit('J') | letter_bit('P') | letter_bit('Q'));
    const PlanePoint written_back = {scaled('P'), scaled('Q')};
    const PlanePoint back = turned_handle(written_back);
    handle = turned_handle(handle);
    curve.points = {start, PlanePoint{start.first + handle.first, start.second + handle.second},
                    PlanePoint{end.first + back.first, end.second + back.second}, end};
    next().spline_end = written_back;
    next().spline_at = end;
    return true;
}

/// I J lead from the start to the only control point.
bool Interpreter::quadratic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve) {
    words_.use(letter_bit('I') | letter_bit('J'));
    const PlanePoint handle = {block().has('I') ? scaled('I') : 0.0, block().has('J') ? scaled('J') : 0.0};
    if (handle.first == 0 && handle.second == 0) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::no_offsets,
            "G5.1 needs I or J, the distance from its start to its control point; write e.g. G5.1 X20 Y0 I10 J10");
    }
    const PlanePoint by = turned_handle(handle);
    curve = quadratic(start, {start.first + by.first, start.second + by.second}, end);
    return true;
}

PlanePoint Interpreter::turned_handle(PlanePoint handle) const {
    if (!frame_now().is_rotated) return handle;
    const Point by = frame_now().rotate({handle.first, handle.second});
    return {by[0], by[1]};
}

/// P and Q may be negative if they are distances, not a time, a tolerance or a depth.
bool Interpreter::negative_handles() const {
    const std::int16_t code = block().has_g(g_motion) ? block().g[g_motion] : modes().motion;
    return code == 50 && !block().has_g(g_nonmodal) && !block().has_g(g_path) && !block().has_m(m_tool) &&
           !block().has_m(m_override);
}

}  // namespace motionrack::control::gcode
