// Interpretation of axis words: their motion code, target, limits and feed rate.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>

namespace motionrack::control::gcode {

namespace {

/// Maximum difference between two computations of the same position in a rotated work system, mm.
constexpr double turned_slack = 1e-9;

bool is_arc(std::int16_t code) {
    return code == 20 || code == 30;
}
bool is_spline(std::int16_t code) {
    return code == 50 || code == 51;
}
bool is_probing(std::int16_t code) {
    return code >= 382 && code <= 385;
}

}  // namespace

bool Interpreter::motion() {
    const bool is_explicit = block().has_g(g_motion);
    std::int16_t code = is_explicit ? block().g[g_motion] : modes().motion;
    if (code == 800) code = no_motion;
    next().motion = code;
    if (is_explicit && is_turning(code)) return turning(code);
    const bool own_axis_words = !words_.axis_words_taken() && (block().words & axis_words) != 0;
    const bool own_offsets = (is_arc(code) || is_spline(code)) && (block().words & offset_words) != 0;
    const bool wants_motion = own_axis_words || (own_offsets && !words_.axis_words_taken());
    if (!wants_motion && !is_explicit && !block().has_g(g_nonmodal)) return true;
    if (!motion_needs(code, wants_motion)) return false;
    if (!wants_motion) return true;
    words_.use(axis_words);
    if (is_arc(code)) return arc(code);
    if (is_cycle(code)) return cycle(code);
    if (is_spline(code)) return spline(code);
    return straight(code);
}

/// Checks the combination of axis words and motion word.
bool Interpreter::motion_needs(std::int16_t code, bool wants_motion) {
    const bool is_explicit = block().has_g(g_motion);
    if (words_.axis_words_taken() && is_explicit && code != no_motion) {
        const GroupG other =
            block().has_g(g_tool_length) && block().g[g_tool_length] != 490 ? g_tool_length : g_nonmodal;
        return words_.fail_at(block().g_column[g_motion], GrblStatus::axis_conflict,
                              fmt::format("{} and {} on one line both use axis words; put them on two lines",
                                          name_of_g(code), name_of_g(block().g[other])));
    }
    if (block().has_g(g_nonmodal) && block().g[g_nonmodal] == 530) {
        const std::size_t column = block().g_column[g_nonmodal];
        if (code != 0 && code != 10) {
            return words_.fail_at(
                column, GrblStatus::g53_without_line,
                fmt::format("G53 (machine coordinates) needs G0 or G1, and {} is active; write e.g. G53 G0 Z0",
                            code == no_motion ? "no motion" : name_of_g(code)));
        }
        if (!wants_motion) {
            return words_.fail_at(column, GrblStatus::no_axis_words,
                                  "axis words missing: G53 needs a target; write e.g. G53 G0 Z0");
        }
    }
    if (code == no_motion && wants_motion) {
        const char letter = static_cast<char>('A' + std::countr_zero(block().words & axis_words));
        return words_.fail_word(letter, GrblStatus::axis_words_unused,
                                fmt::format("{}: no motion is active {}; write G0 (rapid) or G1 (feed) before it",
                                            words_.word_text(letter), is_explicit ? "after G80" : "here"));
    }
    if (is_explicit && !wants_motion && !words_.axis_words_taken() && is_spline(code)) return spline_allowed(code);
    if (is_explicit && !wants_motion && !words_.axis_words_taken() &&
        (is_arc(code) || is_cycle(code) || is_probing(code))) {
        return words_.fail_at(
            block().g_column[g_motion], GrblStatus::no_axis_words,
            is_probing(code) ? fmt::format("{} needs a target to probe towards; write e.g. {} Z-10 F60",
                                           name_of_g(code), name_of_g(code))
            : is_arc(code)   ? fmt::format("{} needs an end and a centre; write e.g. {} X10 Y0 I5 J0", name_of_g(code),
                                           name_of_g(code))
                             : fmt::format("{} needs a position and a depth; write e.g. {} X10 Y10 Z-5 R2",
                                           name_of_g(code), name_of_g(code)));
    }
    return true;
}

/// Computes the targets of the axes that have words.
bool Interpreter::targets(bool machine_coordinates) {
    if (frame_now().is_rotated && !machine_coordinates) return targets_turned();
    const Point& offset = frame_now().offset;
    const bool offset_contour = compensates();
    const int third = next().plane == 0 ? 2 : next().plane == 1 ? 1 : 0;
    for (int axis = 0; axis < axis_count; ++axis) {
        const std::size_t index = axis_letter(axis);
        if ((block().words >> index & 1) == 0) continue;
        const double value = block().value[index] * scale_of(axis);
        const double target = machine_coordinates  ? value
                              : next().incremental ? travel_.position()[axis] + value
                                                   : value + offset[axis];
        if (!(offset_contour && axis < 3 && axis != third) && !reach(axis, target, block().column[index])) return false;
        travel_.end()[axis] = target;
    }
    return offset_contour || !off_path_ || reaches_contour();
}

/// In a rotated work system an X word moves Y as well.
bool Interpreter::targets_turned() {
    const WorkFrame& frame = frame_now();
    const bool offset_contour = compensates();
    const std::uint32_t turning = letter_bit('X') | letter_bit('Y');
    Point program = next().incremental ? Point{} : frame.to_program(travel_.position());
    for (int axis = 0; axis < axis_count; ++axis)
        if ((block().words & letter_bit(axis_letters[axis])) != 0)
            program[axis] = block().value[axis_letter(axis)] * scale_of(axis);
    const Point by = frame.rotate(program), to = frame.to_machine(program);
    for (int axis = 0; axis < axis_count; ++axis) {
        const std::uint32_t own = letter_bit(axis_letters[axis]);
        if ((block().words & (axis < 2 ? turning : own)) == 0) continue;
        const double target = next().incremental ? travel_.position()[axis] + by[axis] : to[axis];
        const int blamed = (block().words & own) != 0 ? axis : 1 - axis;
        const bool absent = (travel_.present_words() & own) == 0 && target == travel_.position()[axis];
        const bool in_plane = offset_contour && axis < 2;
        if (!absent && !in_plane && !reach(axis, target, block().column[axis_letter(blamed)])) return false;
        travel_.end()[axis] = target;
    }
    // A rounding error must not become a move: in cutter compensation it would have a direction.
    if (!next().incremental && std::fabs(travel_.end()[0] - travel_.position()[0]) < turned_slack &&
        std::fabs(travel_.end()[1] - travel_.position()[1]) < turned_slack) {
        travel_.end()[0] = travel_.position()[0];
        travel_.end()[1] = travel_.position()[1];
    }
    return offset_contour || !off_path_ || reaches_contour();
}

bool Interpreter::straight(std::int16_t code) {
    if (is_probing(code) && !may_probe(code)) return false;
    if (!targets(block().has_g(g_nonmodal) && block().g[g_nonmodal] == 530)) return false;
    Move& move = steps_.moving().move;
    move.kind = code == 0 ? MoveKind::rapid : MoveKind::feed;
    move.path = next().path;
    move.tolerance_mm = next().tolerance_mm;
    move.line = words_.number();
    move.end = travel_.end();
    move.feed = 0;
    move.feed_mode = FeedMode::units_per_second;
    if (code != 0 && (!by_itself(code) || !feed_of(move))) return false;
    steps_.moving().probe = Probe::none;
    if (is_probing(code) && !probing(code)) return false;
    steps_.moving().line = words_.number();
    steps_.add_move();
    return !compensates() || compensate();
}

/// Where each axis positions independently, only one of them can make a feed move.
bool Interpreter::by_itself(std::int16_t code) {
    if (!settings_.point_to_point) return true;
    std::string moving;
    for (int axis = 0; axis < axis_count; ++axis)
        if (travel_.end()[axis] != travel_.position()[axis])
            moving += (moving.empty() ? "" : ", ") + std::string(1, axis_letters[axis]);
    if (moving.size() <= 1 && !is_arc(code)) return true;
    return words_.fail_at(
        words_.error_column(), GrblStatus::unsupported,
        is_arc(code)
            ? fmt::format("{} is an arc, but the axes of this rack position one by one; write straight moves",
                          name_of_g(code))
            : fmt::format(
                  "{} moves {} together, but the axes of this rack position one by one; write a line for each, or G0, "
                  "where each axis moves at its own velocity",
                  name_of_g(code), moving));
}

/// Starts a move of the current line with the active modes, to the targets of the words.
Move& Interpreter::begin_move(MoveKind kind) {
    steps_.moving().line = words_.number();
    steps_.moving().probe = Probe::none;
    Move& move = steps_.moving().move;
    move = Move{};
    move.kind = kind;
    move.path = next().path;
    move.tolerance_mm = next().tolerance_mm;
    move.line = words_.number();
    move.end = travel_.end();
    return move;
}

bool Interpreter::feed_of(Move& move) {
    if (next().inverse_time) {
        if (!block().has('F') || next().feed == 0) return no_feed();
        move.feed_mode = FeedMode::inverse_time;
        move.feed = next().feed;
        return true;
    }
    if (next().feed == 0) return no_feed();
    const bool rotary_only = !(off_path_ && next().cutter == CutterSide::off) &&
                             travel_.end()[0] == travel_.position()[0] && travel_.end()[1] == travel_.position()[1] &&
                             travel_.end()[2] == travel_.position()[2] && (block().words & rotary_words) != 0 &&
                             move.kind == MoveKind::feed;
    move.feed_mode = FeedMode::units_per_second;
    move.feed = rotary_only ? next().feed_rotary : next().feed;
    return true;
}

bool Interpreter::no_feed() {
    const std::string code = name_of_g(next().motion);
    if (block().has('F')) {
        return words_.fail_word(
            'F', GrblStatus::no_feed,
            fmt::format("{}: {} cannot move at feed 0; write e.g. F600", words_.word_text('F'), code));
    }
    if (next().inverse_time) {
        return words_.fail_at(
            words_.error_column(), GrblStatus::no_feed,
            fmt::format("F word missing: in G93 every {} line needs its own; write e.g. F2 (the move takes 1/2 minute)",
                        code));
    }
    return words_.fail_at(
        words_.error_column(), GrblStatus::no_feed,
        fmt::format("F word missing: {} needs a feed; write e.g. F600 ({}/min) on this line or before it", code,
                    next().inch ? "inch" : "mm"));
}

bool Interpreter::exceeds_travel(int axis, double value, std::size_t column) {
    const AxisLimits& limits = settings_.limits[axis];
    const char* unit = axis < 3 ? "mm" : "degrees";
    const double offset = frame_now().offset[axis];
    const std::string shift = offset == 0 ? std::string() : fmt::format(" (the work offset is {:.6g})", offset);
    return words_.fail_at(
        column, GrblStatus::travel_exceeded,
        fmt::format("{} leads to {} = {:.6g} {} in machine coordinates{}, but the axis goes from {:.6g} to {:.6g}; "
                    "the line was not executed; move the work or change its offset",
                    word_at(block().text, column), axis_letters[axis], value, unit, shift, limits.min_position,
                    limits.max_position),
        ErrorKind::refused);
}

}  // namespace motionrack::control::gcode
