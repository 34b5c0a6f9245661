// Targets, limits and feed rates of moves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/move_reader.hpp>
#include <motionrack/control/gcode/plane_point.hpp>
#include <motionrack/control/geometry.hpp>

namespace motionrack::control::gcode {

namespace {

/// Maximum difference between two computations of the same position in a rotated work system, mm.
constexpr double turned_slack = 1e-9;

}  // namespace

/// Computes the targets of the axes that have words.
bool MoveReader::targets(bool machine_coordinates) {
    if (frame_now().is_rotated && !machine_coordinates) return targets_turned();
    const Point& offset = frame_now().offset;
    const bool offset_contour = compensates();
    const int third = next().plane == 0 ? 2 : next().plane == 1 ? 1 : 0;
    for (int axis = 0; axis < axis_count; ++axis) {
        const std::size_t index = axis_letter(axis);
        if ((block().words >> index & 1) == 0) continue;
        const double value = block().value[index] * scale_of(axis);
        const double target = machine_coordinates  ? value
                              : next().incremental ? travel().position()[axis] + value
                                                   : value + offset[axis];
        if (!(offset_contour && axis < 3 && axis != third) && !reach(axis, target, block().column[index])) return false;
        travel().end()[axis] = target;
    }
    return offset_contour || !cutter().is_off_path() || reaches_contour();
}

/// Computes the targets in a rotated work system, where an X word moves Y as well.
bool MoveReader::targets_turned() {
    const WorkFrame& frame = frame_now();
    const bool offset_contour = compensates();
    const std::uint32_t turning = letter_bit('X') | letter_bit('Y');
    Point program = next().incremental ? Point{} : frame.to_program(travel().position());
    for (int axis = 0; axis < axis_count; ++axis)
        if ((block().words & letter_bit(axis_letters[axis])) != 0)
            program[axis] = block().value[axis_letter(axis)] * scale_of(axis);
    const Point by = frame.rotate(program), to = frame.to_machine(program);
    for (int axis = 0; axis < axis_count; ++axis) {
        const std::uint32_t own = letter_bit(axis_letters[axis]);
        if ((block().words & (axis < 2 ? turning : own)) == 0) continue;
        const double target = next().incremental ? travel().position()[axis] + by[axis] : to[axis];
        const int blamed = (block().words & own) != 0 ? axis : 1 - axis;
        const bool absent = (travel().present_words() & own) == 0 && target == travel().position()[axis];
        const bool in_plane = offset_contour && axis < 2;
        if (!absent && !in_plane && !reach(axis, target, block().column[axis_letter(blamed)])) return false;
        travel().end()[axis] = target;
    }
    // A rounding error must not become a move: in cutter compensation it would have a direction.
    if (!next().incremental && std::fabs(travel().end()[0] - travel().position()[0]) < turned_slack &&
        std::fabs(travel().end()[1] - travel().position()[1]) < turned_slack) {
        travel().end()[0] = travel().position()[0];
        travel().end()[1] = travel().position()[1];
    }
    return offset_contour || !cutter().is_off_path() || reaches_contour();
}

/// Starts a move of the current line with the active modes, to the targets of the words.
Move& MoveReader::begin_move(MoveKind kind) {
    steps().moving().line = line_number();
    steps().moving().probe = Probe::none;
    Move& move = steps().moving().move;
    move = Move{};
    move.kind = kind;
    move.path = next().path;
    move.tolerance_mm = next().tolerance_mm;
    move.line = line_number();
    move.end = travel().end();
    return move;
}

bool MoveReader::feed_of(Move& move) {
    if (next().inverse_time) {
        if (!block().has('F') || next().feed == 0) return no_feed();
        move.feed_mode = FeedMode::inverse_time;
        move.feed = next().feed;
        return true;
    }
    if (next().feed == 0) return no_feed();
    const bool rotary_only =
        !(cutter().is_off_path() && next().cutter == CutterSide::off) && travel().end()[0] == travel().position()[0] &&
        travel().end()[1] == travel().position()[1] && travel().end()[2] == travel().position()[2] &&
        (block().words & rotary_words) != 0 && move.kind == MoveKind::feed;
    move.feed_mode = FeedMode::units_per_second;
    move.feed = rotary_only ? next().feed_rotary : next().feed;
    return true;
}

bool MoveReader::no_feed() {
    const std::string code = name_of_g(next().motion);
    if (block().has('F')) {
        return fail_word('F', GrblStatus::no_feed,
                         fmt::format("{}: {} cannot move at feed 0; write e.g. F600", word_text('F'), code));
    }
    if (next().inverse_time) {
        return fail_at(
            error_column(), GrblStatus::no_feed,
            fmt::format("F word missing: in G93 every {} line needs its own; write e.g. F2 (the move takes 1/2 minute)",
                        code));
    }
    return fail_at(error_column(), GrblStatus::no_feed,
                   fmt::format("F word missing: {} needs a feed; write e.g. F600 ({}/min) on this line or before it",
                               code, next().inch ? "inch" : "mm"));
}

/// Refuses arcs and feed moves of several axes on a machine whose axes position independently.
bool MoveReader::by_itself(std::int16_t code) {
    if (!settings().point_to_point) return true;
    std::string moving;
    for (int axis = 0; axis < axis_count; ++axis)
        if (travel().end()[axis] != travel().position()[axis])
            moving += (moving.empty() ? "" : ", ") + std::string(1, axis_letters[axis]);
    if (moving.size() <= 1 && !is_arc(code)) return true;
    return fail_at(
        error_column(), GrblStatus::unsupported,
        is_arc(code)
            ? fmt::format("{} is an arc, but the axes of this rack position one by one; write straight moves",
                          name_of_g(code))
            : fmt::format(
                  "{} moves {} together, but the axes of this rack position one by one; write a line for each, or G0, "
                  "where each axis moves at its own velocity",
                  name_of_g(code), moving));
}

bool MoveReader::exceeds_travel(int axis, double value, std::size_t column) {
    const AxisLimits& limits = settings().limits[axis];
    const char* unit = axis < 3 ? "mm" : "degrees";
    const double offset = frame_now().offset[axis];
    const std::string shift = offset == 0 ? std::string() : fmt::format(" (the work offset is {:.6g})", offset);
    return fail_at(
        column, GrblStatus::travel_exceeded,
        fmt::format("{} leads to {} = {:.6g} {} in machine coordinates{}, but the axis goes from {:.6g} to {:.6g}; "
                    "the line was not executed; move the work or change its offset",
                    word_at(block().text, column), axis_letters[axis], value, unit, shift, limits.min_position,
                    limits.max_position),
        ErrorKind::refused);
}

/// Refuses arcs and cycles of G18 and G19 in a rotated work system: an arc would not lie in a plane of two axes, a
/// cycle would drill on a slant.
bool MoveReader::in_turned_plane(std::int16_t code) {
    if (!frame_now().is_rotated || next().plane == 0) return true;
    return fail_at(error_column(), GrblStatus::unsupported,
                   fmt::format("{} in {}: the work system is rotated by {:.6g} degrees (G10 L2 R); arcs and cycles "
                               "are then possible in G17 only; write G17, or end the rotation",
                               name_of_g(code), plane_names[next().plane], frame_now().rotation_deg[next().system]));
}

bool MoveReader::arc_within_limits(PlanePoint start, PlanePoint end, PlanePoint centre, std::int32_t turns) {
    const auto& axes = plane_axes[next().plane];
    const PlanePoint from = {start.first - centre.first, start.second - centre.second};
    const PlanePoint to = {end.first - centre.first, end.second - centre.second};
    const double radius = std::max(length(from), length(to));
    const std::array<double, 4> extremes = {centre.first + radius, centre.second + radius, centre.first - radius,
                                            centre.second - radius};
    const std::array<int, 4> axis = {axes[0], axes[1], axes[0], axes[1]};
    bool inside = true;
    for (int i = 0; i < 4; ++i) inside = inside && travel().contains(axis[i], extremes[i]);
    if (inside) return true;
    // As geometry_of() decides it: a rounded end may have the direction of the start, but another radius.
    const double angle = motionrack::atan2(cross(from, to), dot(from, to));
    const bool full = std::abs(turns) > 1 || std::fabs(angle) < min_sweep_rad;
    const auto passed = full ? std::array<bool, 4>{true, true, true, true} : extremes_passed(from, to, turns > 0);
    for (int i = 0; i < 4; ++i) {
        if (passed[i] && !reach(axis[i], extremes[i], error_column())) {
            in_.words.prefix_problem("this arc exceeds the travel: ");
            return false;
        }
    }
    return true;
}

/// Checks the return from the offset path to the contour, which may be outside the limits.
bool MoveReader::reaches_contour() {
    for (int axis = 0; axis < 3; ++axis)
        if (travel().end()[axis] != travel().position()[axis] || travel().end()[axis] != cutter().at()[axis])
            if (!reach(axis, travel().end()[axis], error_column())) return false;
    return true;
}

/// Refuses a move other than a straight one after G40, while the cutter is still on the offset path.
bool MoveReader::leaves_straight(std::int16_t code) {
    if (!cutter().is_off_path() || (cutter().is_compensating() && next().cutter != CutterSide::off)) return true;
    return fail_at(error_column(), GrblStatus::bad_target,
                   fmt::format("{} after G40: the cutter is still at the offset contour; leave it with a straight move",
                               name_of_g(code)));
}

}  // namespace motionrack::control::gcode
