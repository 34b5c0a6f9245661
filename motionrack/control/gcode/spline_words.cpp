// Curves.
#include <fmt/format.h>

#include <motionrack/control/gcode/biarc_approximator.hpp>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/spline_words.hpp>

namespace motionrack::control::gcode {

bool SplineWords::read(std::int16_t code) {
    if (!spline_allowed(code) || !targets(false)) return false;
    const PlanePoint start = {travel().position()[0], travel().position()[1]};
    const PlanePoint end = {travel().end()[0], travel().end()[1]};
    CubicBezier curve;
    if (!(code == 50 ? cubic_of_words(start, end, curve) : quadratic_of_words(start, end, curve))) return false;
    if (curve.is_point()) {
        return fail_at(
            error_column(), GrblStatus::bad_target,
            fmt::format("{}: the curve has no length; its end and control points are its start", name_of_g(code)));
    }
    for (const int axis : {0, 1}) {
        double min = 0, max = 0;
        curve.range(axis == 0 ? &PlanePoint::first : &PlanePoint::second, min, max);
        if (!reach(axis, min, error_column()) || !reach(axis, max, error_column())) {
            in_.words.prefix_problem("this curve exceeds the travel: ");
            return false;
        }
    }
    if (!feed_of(begin_move(MoveKind::arc))) return false;
    steps().add_spline(curve);
    return true;
}

bool SplineWords::spline_allowed(std::int16_t code) {
    const std::string name = name_of_g(code);
    const auto refuse = [&](GrblStatus status, const std::string& why) {
        return fail_at(error_column(), status, name + why);
    };
    if (settings().point_to_point)
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
        return fail_word(
            letter, GrblStatus::unused_word,
            fmt::format("{}: {} moves X and Y only; put the other axes on a separate line", word_text(letter), name));
    }
    return true;
}

/// Reads the control points of G5: I J lead from the start to the first one, P Q from the end to the second one.
bool SplineWords::cubic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve) {
    if (!block().has('P') || !block().has('Q')) {
        return fail_at(error_column(), GrblStatus::word_missing,
                       "G5 needs P and Q, the distance from its end to its second control point; write e.g. G5 X20 Y0 "
                       "I5 J10 P-5 Q10");
    }
    if (block().has('I') != block().has('J')) {
        const char missing = block().has('I') ? 'J' : 'I';
        return fail_at(
            error_column(), GrblStatus::no_offsets,
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
        return fail_at(error_column(), GrblStatus::no_offsets,
                       "G5 needs I and J, the distance from its start to its first control point; only a G5 right "
                       "after another may omit them");
    }
    if (!claim_for_g(50, letter_bit('P') | letter_bit('Q'))) return false;
    use(letter_bit('I') | letter_bit('J'));
    const PlanePoint written_back = {scaled('P'), scaled('Q')};
    const PlanePoint back = turned_handle(written_back);
    handle = turned_handle(handle);
    curve.points = {start, PlanePoint{start.first + handle.first, start.second + handle.second},
                    PlanePoint{end.first + back.first, end.second + back.second}, end};
    next().spline_end = written_back;
    next().spline_at = end;
    return true;
}

/// Reads the only control point of G5.1: I J lead from the start to it.
bool SplineWords::quadratic_of_words(PlanePoint start, PlanePoint end, CubicBezier& curve) {
    use(letter_bit('I') | letter_bit('J'));
    const PlanePoint handle = {block().has('I') ? scaled('I') : 0.0, block().has('J') ? scaled('J') : 0.0};
    if (handle.first == 0 && handle.second == 0) {
        return fail_at(
            error_column(), GrblStatus::no_offsets,
            "G5.1 needs I or J, the distance from its start to its control point; write e.g. G5.1 X20 Y0 I10 J10");
    }
    const PlanePoint by = turned_handle(handle);
    curve = quadratic(start, {start.first + by.first, start.second + by.second}, end);
    return true;
}

PlanePoint SplineWords::turned_handle(PlanePoint handle) const {
    if (!frame_now().is_rotated) return handle;
    const Point by = frame_now().rotate({handle.first, handle.second});
    return {by[0], by[1]};
}

}  // namespace motionrack::control::gcode
