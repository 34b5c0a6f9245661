// Arcs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/control/gcode/arc_words.hpp>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/cutter_compensation.hpp>
#include <motionrack/control/gcode/plane_point.hpp>

namespace motionrack::control::gcode {

namespace {

/// Allowed difference between start and end radius (mm), or 0.1 % of the radius up to the second number; as Grbl,
/// LinuxCNC.
constexpr double radius_difference_mm = 0.005;
constexpr double radius_difference_relative = 0.001;
constexpr double max_radius_difference_mm = 0.5;

/// An end within this distance of the start (mm) makes a full turn.
constexpr double same_point_mm = 1e-7;

constexpr double max_turns = 100'000;

constexpr std::array<char, 3> offset_letters = {'I', 'J', 'K'};

}  // namespace

bool ArcWords::read(std::int16_t code) {
    if (!by_itself(code) || !in_turned_plane(code) || !leaves_straight(code) || !targets(false)) return false;
    const auto& axes = plane_axes[next().plane];
    const bool counter_clockwise = code == 30;
    double turns = 1;
    if (!claim_for_g(code, letter_bit('P'))) return false;
    if (block().has('P')) {
        if (!need_integer('P', 1, max_turns, "the number of turns of an arc")) return false;
        turns = block()['P'];
    }
    PlanePoint centre;
    if (!arc_centre(counter_clockwise, centre)) return false;
    Move& move = begin_move(MoveKind::arc);
    move.first = axes[0];
    move.second = axes[1];
    move.turns = static_cast<std::int32_t>(counter_clockwise ? turns : -turns);
    move.centre_first = centre.first;
    move.centre_second = centre.second;
    if (!feed_of(move)) return false;
    steps().add_move();
    if (compensates()) return CutterCompensation(in_).compensate();
    return arc_within_limits({travel().position()[axes[0]], travel().position()[axes[1]]},
                             {travel().end()[axes[0]], travel().end()[axes[1]]}, centre, move.turns);
}

/// Computes the centre from R or from I J K.
bool ArcWords::arc_centre(bool counter_clockwise, PlanePoint& centre) {
    const auto& axes = plane_axes[next().plane];
    const PlanePoint start = {travel().position()[axes[0]], travel().position()[axes[1]]};
    const PlanePoint end = {travel().end()[axes[0]], travel().end()[axes[1]]};
    const bool closed =
        std::fabs(end.first - start.first) <= same_point_mm && std::fabs(end.second - start.second) <= same_point_mm;
    if (block().has('R')) return arc_centre_of_radius(start, end, closed, counter_clockwise, centre);
    if (!arc_centre_of_offsets(start, centre)) return false;
    if (closed) {
        travel().end()[axes[0]] = start.first;
        travel().end()[axes[1]] = start.second;
    }
    return arc_radii_agree(start, closed ? start : end, centre);
}

bool ArcWords::arc_centre_of_radius(PlanePoint start, PlanePoint end, bool closed, bool counter_clockwise,
                                    PlanePoint& centre) {
    const auto& axes = plane_axes[next().plane];
    if (!claim_for_g(next().motion, letter_bit('R'))) return false;
    const std::uint32_t plane_words = letter_bit(axis_letters[axes[0]]) | letter_bit(axis_letters[axes[1]]);
    if ((block().words & plane_words) == 0) {
        return fail_at(error_column(), GrblStatus::no_plane_axis,
                       fmt::format("an arc with R needs an end in its plane, {} ({} or {})", plane_names[next().plane],
                                   axis_letters[std::min(axes[0], axes[1])], axis_letters[std::max(axes[0], axes[1])]));
    }
    if (block()['R'] == 0)
        return fail_word('R', GrblStatus::bad_target, "R0: an arc cannot have radius 0; use G1 for a line");
    if (closed) {
        return fail_word(
            'R', GrblStatus::bad_target,
            fmt::format("{}: an arc with R cannot end where it starts; write a full turn with offsets, e.g. {} I10",
                        word_text('R'), name_of_g(next().motion)));
    }
    const double radius = scaled('R');
    if (centre_from_radius(start, end, radius, counter_clockwise, centre)) return true;
    const double chord = length({end.first - start.first, end.second - start.second});
    return fail_word(
        'R', GrblStatus::bad_radius,
        fmt::format("{}: the radius is {:.6g} mm but the end is {:.6g} mm away; it must be at least {:.6g} mm",
                    word_text('R'), std::fabs(radius), chord, chord / 2));
}

bool ArcWords::arc_centre_of_offsets(PlanePoint start, PlanePoint& centre) {
    const auto& axes = plane_axes[next().plane];
    const std::array<char, 2> letters = {offset_letters[axes[0]], offset_letters[axes[1]]};
    if (!block().has(letters[0]) && !block().has(letters[1])) {
        return fail_at(
            error_column(), GrblStatus::no_offsets,
            fmt::format("{} needs the centre ({} {} in {}) or the radius (R)", name_of_g(next().motion),
                        std::min(letters[0], letters[1]), std::max(letters[0], letters[1]), plane_names[next().plane]));
    }
    Point words = {};
    std::array<double, 2> middle = {start.first, start.second};
    for (int i = 0; i < 2; ++i) {
        use(letter_bit(letters[i]));
        if (block().has(letters[i])) {
            words[axes[i]] = scaled(letters[i]);
            middle[i] = scaled(letters[i]) + (next().arc_absolute ? frame_now().offset[axes[i]] : middle[i]);
        } else if (next().arc_absolute) {
            return fail_at(error_column(), GrblStatus::no_offsets,
                           fmt::format("{} word missing: in G90.1 (absolute centres) {} needs both {} and {}",
                                       letters[i], name_of_g(next().motion), std::min(letters[0], letters[1]),
                                       std::max(letters[0], letters[1])));
        }
    }
    centre = {middle[0], middle[1]};
    if (const WorkFrame& frame = frame_now(); frame.is_rotated) {  // G17: the first axis is X, the second is Y
        const Point by = next().arc_absolute ? frame.to_machine(words) : frame.rotate(words);
        centre = next().arc_absolute ? PlanePoint{by[0], by[1]} : PlanePoint{start.first + by[0], start.second + by[1]};
    }
    return true;
}

bool ArcWords::arc_radii_agree(PlanePoint start, PlanePoint end, PlanePoint centre) {
    const auto& axes = plane_axes[next().plane];
    const char letter = block().has(offset_letters[axes[0]]) ? offset_letters[axes[0]] : offset_letters[axes[1]];
    const double radius = length({start.first - centre.first, start.second - centre.second});
    const double end_radius = length({end.first - centre.first, end.second - centre.second});
    if (radius == 0 || end_radius == 0) {
        return fail_word(letter, GrblStatus::bad_target,
                         fmt::format("{}: the radius of this arc is 0; its {} lies on the centre", word_text(letter),
                                     radius == 0 ? "start" : "end"));
    }
    const double difference = std::fabs(radius - end_radius);
    const double allowed =
        std::min(radius_difference_relative * std::max(radius, end_radius), max_radius_difference_mm);
    if (difference <= radius_difference_mm || difference <= allowed) return true;
    return fail_word(
        letter, GrblStatus::bad_target,
        fmt::format("{}: the arc starts {:.6g} mm from its centre but ends {:.6g} mm from it; they may differ by "
                    "0.005 mm or 0.1 %; correct the centre or the end",
                    word_text(letter), radius, end_radius));
}

}  // namespace motionrack::control::gcode
