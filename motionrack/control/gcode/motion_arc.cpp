// G2 and G3: centre, turns, and limits over the whole arc.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>
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
constexpr std::array<const char*, 3> plane_names = {"G17 (XY)", "G18 (XZ)", "G19 (YZ)"};

}  // namespace

bool Interpreter::arc(std::int16_t code) {
    if (!by_itself(code) || !in_turned_plane(code) || !leaves_straight(code) || !targets(false)) return false;
    const auto& axes = plane_axes[next().plane];
    const bool counter_clockwise = code == 30;
    double turns = 1;
    if (block().has('P') && (words_.used() & letter_bit('P')) == 0) {
        if (!words_.need_integer('P', 1, max_turns, "the number of turns of an arc")) return false;
        turns = block()['P'];
        words_.use(letter_bit('P'));
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
    steps_.add_move();
    if (compensates()) return compensate();
    return arc_within_limits({travel_.position()[axes[0]], travel_.position()[axes[1]]},
                             {travel_.end()[axes[0]], travel_.end()[axes[1]]}, centre, move.turns);
}

/// In a rotated work system an arc of G18 or G19 would not lie in a plane of two axes; a cycle would drill on a slant.
bool Interpreter::in_turned_plane(std::int16_t code) {
    if (!frame_now().is_rotated || next().plane == 0) return true;
    return words_.fail_at(
        words_.error_column(), GrblStatus::unsupported,
        fmt::format("{} in {}: the work system is turned by {:.6g} degrees (G10 L2 R), where arcs and "
                    "cycles are possible in G17 only",
                    name_of_g(code), plane_names[next().plane], frame_now().rotation_deg[next().system]));
}

/// Computes the centre from R or from I J K.
bool Interpreter::arc_centre(bool counter_clockwise, PlanePoint& centre) {
    const auto& axes = plane_axes[next().plane];
    const PlanePoint start = {travel_.position()[axes[0]], travel_.position()[axes[1]]};
    const PlanePoint end = {travel_.end()[axes[0]], travel_.end()[axes[1]]};
    const bool closed =
        std::fabs(end.first - start.first) <= same_point_mm && std::fabs(end.second - start.second) <= same_point_mm;
    if (block().has('R')) return arc_centre_of_radius(start, end, closed, counter_clockwise, centre);
    if (!arc_centre_of_offsets(start, centre)) return false;
    if (closed) {
        travel_.end()[axes[0]] = start.first;
        travel_.end()[axes[1]] = start.second;
    }
    return arc_radii_agree(start, closed ? start : end, centre);
}

bool Interpreter::arc_centre_of_radius(PlanePoint start, PlanePoint end, bool closed, bool counter_clockwise,
                                       PlanePoint& centre) {
    const auto& axes = plane_axes[next().plane];
    words_.use(letter_bit('R'));
    const std::uint32_t plane_words = letter_bit(axis_letters[axes[0]]) | letter_bit(axis_letters[axes[1]]);
    if ((block().words & plane_words) == 0) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::no_plane_axis,
            fmt::format("an arc with R needs an end in its plane, {} ({} or {})", plane_names[next().plane],
                        axis_letters[std::min(axes[0], axes[1])], axis_letters[std::max(axes[0], axes[1])]));
    }
    if (block()['R'] == 0)
        return words_.fail_word('R', GrblStatus::bad_target, "R0: an arc cannot have radius 0; use G1 for a line");
    if (closed) {
        return words_.fail_word(
            'R', GrblStatus::bad_target,
            fmt::format("{}: an arc with R cannot end where it starts; write a full turn with offsets, e.g. {} I10",
                        words_.word_text('R'), name_of_g(next().motion)));
    }
    const double radius = scaled('R');
    if (centre_from_radius(start, end, radius, counter_clockwise, centre)) return true;
    const double chord = length({end.first - start.first, end.second - start.second});
    return words_.fail_word(
        'R', GrblStatus::bad_radius,
        fmt::format("{}: the radius is {:.6g} mm but the end is {:.6g} mm away; it must be at least {:.6g} mm",
                    words_.word_text('R'), std::fabs(radius), chord, chord / 2));
}

bool Interpreter::arc_centre_of_offsets(PlanePoint start, PlanePoint& centre) {
    const auto& axes = plane_axes[next().plane];
    const std::array<char, 2> letters = {offset_letters[axes[0]], offset_letters[axes[1]]};
    if (!block().has(letters[0]) && !block().has(letters[1])) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::no_offsets,
            fmt::format("{} needs the centre ({} {} in {}) or the radius (R)", name_of_g(next().motion),
                        std::min(letters[0], letters[1]), std::max(letters[0], letters[1]), plane_names[next().plane]));
    }
    Point words = {};
    std::array<double, 2> middle = {start.first, start.second};
    for (int i = 0; i < 2; ++i) {
        words_.use(letter_bit(letters[i]));
        if (block().has(letters[i])) {
            words[axes[i]] = scaled(letters[i]);
            middle[i] = scaled(letters[i]) + (next().arc_absolute ? frame_now().offset[axes[i]] : middle[i]);
        } else if (next().arc_absolute) {
            return words_.fail_at(words_.error_column(), GrblStatus::no_offsets,
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

bool Interpreter::arc_radii_agree(PlanePoint start, PlanePoint end, PlanePoint centre) {
    const auto& axes = plane_axes[next().plane];
    const char letter = block().has(offset_letters[axes[0]]) ? offset_letters[axes[0]] : offset_letters[axes[1]];
    const double radius = length({start.first - centre.first, start.second - centre.second});
    const double end_radius = length({end.first - centre.first, end.second - centre.second});
    if (radius == 0 || end_radius == 0) {
        return words_.fail_word(letter, GrblStatus::bad_target,
                                fmt::format("{}: the radius of this arc is 0; its {} lies on the centre",
                                            words_.word_text(letter), radius == 0 ? "start" : "end"));
    }
    const double difference = std::fabs(radius - end_radius);
    const double allowed =
        std::min(radius_difference_relative * std::max(radius, end_radius), max_radius_difference_mm);
    if (difference <= radius_difference_mm || difference <= allowed) return true;
    return words_.fail_word(
        letter, GrblStatus::bad_target,
        fmt::format("{}: the arc starts {:.6g} mm from its centre but ends {:.6g} mm from it; they may differ by "
                    "0.005 mm or 0.1 %; correct the centre or the end",
                    words_.word_text(letter), radius, end_radius));
}

bool Interpreter::arc_within_limits(PlanePoint start, PlanePoint end, PlanePoint centre, std::int32_t turns) {
    const auto& axes = plane_axes[next().plane];
    const PlanePoint from = {start.first - centre.first, start.second - centre.second};
    const PlanePoint to = {end.first - centre.first, end.second - centre.second};
    const double radius = std::max(length(from), length(to));
    const std::array<double, 4> extremes = {centre.first + radius, centre.second + radius, centre.first - radius,
                                            centre.second - radius};
    const std::array<int, 4> axis = {axes[0], axes[1], axes[0], axes[1]};
    bool inside = true;
    for (int i = 0; i < 4; ++i) inside = inside && travel_.contains(axis[i], extremes[i]);
    if (inside) return true;
    const bool full = std::abs(turns) > 1 || (from.first == to.first && from.second == to.second);
    const auto passed = full ? std::array<bool, 4>{true, true, true, true} : extremes_passed(from, to, turns > 0);
    for (int i = 0; i < 4; ++i) {
        if (passed[i] && !reach(axis[i], extremes[i], words_.error_column())) {
            words_.prefix_problem("this arc exceeds the travel: ");
            return false;
        }
    }
    return true;
}

}  // namespace motionrack::control::gcode
