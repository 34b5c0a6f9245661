// Drilling cycles.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/drill_cycle.hpp>
#include <motionrack/control/gcode/drill_words.hpp>
#include <motionrack/control/gcode/plane_point.hpp>
#include <motionrack/control/gcode/words.hpp>

namespace motionrack::control::gcode {

namespace {

constexpr double max_repeats = 10'000;
constexpr double max_pecks = 100'000;

/// Bit in ModalState::cycle_words for the word of the drilling axis, whatever its letter.
constexpr std::uint32_t depth_word = letter_bit('Z');

}  // namespace

/// Reads the words that the cycle stores from line to line; each must follow the cycle's own G word.
bool DrillWords::cycle_words(std::int16_t code) {
    const char depth = axis_letters[plane_axes[next().plane][2]];
    if (modes().motion != code) next().cycle_words = 0;
    const auto keep = [&](std::uint32_t mark, double& kept, double value) {
        kept = value;
        next().cycle_words |= mark;
    };
    const bool taps = code == 740 || code == 840, waits = code == 820 || code == 860 || code == 890;
    if (!claim_for_g(code, rule_of_g(code).letters & (letter_bit('P') | letter_bit('Q') | letter_bit('R'))))
        return false;
    if (block().has('R')) keep(letter_bit('R'), next().cycle_r, scaled('R'));
    if (block().has(depth)) keep(depth_word, next().cycle_z, scaled(depth));
    if (taps && next().cycle_words == 0) next().cycle_p = 0;
    if ((waits || taps) && block().has('P')) keep(letter_bit('P'), next().cycle_p, block()['P']);
    if (is_pecking(code) && block().has('Q')) keep(letter_bit('Q'), next().cycle_q, scaled('Q'));
    const std::uint32_t needed =
        letter_bit('R') | depth_word | (waits ? letter_bit('P') : 0) | (is_pecking(code) ? letter_bit('Q') : 0);
    const std::uint32_t missing = needed & ~next().cycle_words;
    if (missing == 0) return true;
    const bool no_depth = (missing & depth_word) != 0;
    const char letter = no_depth ? depth : static_cast<char>('A' + std::countr_zero(missing));
    const char* what = no_depth        ? "the depth of the hole"
                       : letter == 'R' ? "the height to which to rapid, e.g. R2"
                       : letter == 'P' ? "the wait at the bottom in seconds, e.g. P0.5"
                                       : "the depth of a peck, e.g. Q1.5";
    return fail_at(error_column(), GrblStatus::word_missing,
                   fmt::format("{} word missing: {} needs {}", letter, name_of_g(code), what));
}

/// Refuses G74, G84 and G86 if the spindle does not turn, and tapping if it turns in the wrong direction: tapping
/// reverses the spindle at the bottom (the tap floats in its chuck), G86 stops it.
bool DrillWords::spindle_turns(std::int16_t code) {
    const Spindle needed = code == 740 ? Spindle::counter_clockwise : code == 840 ? Spindle::clockwise : next().spindle;
    if (code != 740 && code != 840 && code != 860) return true;
    if (next().spindle != Spindle::off && next().spindle == needed) return true;
    return fail_at(error_column(), GrblStatus::unsupported,
                   fmt::format("{} needs the spindle turning{}; write e.g. S500 {} before it", name_of_g(code),
                               code == 740   ? " counter-clockwise"
                               : code == 840 ? " clockwise"
                                             : "",
                               code == 740 ? "M4" : "M3"));
}

/// Rejects a peck that is too thin for the depth of the hole, because the cycle would not end in useful time.
bool DrillWords::pecks_go(const DrillCycle& plan) {
    if (!is_pecking(plan.code) || (plan.peck * max_pecks >= (plan.r - plan.bottom) * plan.repeats && plan.peck > 0))
        return true;
    return fail_at(
        block().has('Q') ? block().column[letter_index('Q')] : error_column(), GrblStatus::bad_target,
        fmt::format("the peck depth Q is {:.6g} mm for {} of {:.6g} mm; it must be above 0 and give at most 100000 "
                    "pecks per line",
                    plan.peck, plan.repeats == 1 ? std::string("a hole") : fmt::format("{} holes", plan.repeats),
                    plan.r - plan.bottom));
}

bool DrillWords::allows(std::int16_t code) {
    if (next().cutter != CutterSide::off) {
        return fail_at(
            error_column(), GrblStatus::axis_conflict,
            fmt::format("{} cannot drill while cutter compensation is on; write G40 and a straight move before it",
                        name_of_g(code)));
    }
    if (!leaves_straight(code)) return false;
    if ((block().words & rotary_words) != 0) {
        const char letter = static_cast<char>('A' + std::countr_zero(block().words & rotary_words));
        return fail_word(letter, GrblStatus::unused_word,
                         fmt::format("{}: a drilling cycle does not turn axes; put the turn on a line before it",
                                     word_text(letter)));
    }
    if (next().inverse_time) {
        return fail_at(
            error_column(), GrblStatus::no_feed,
            fmt::format("{} cannot be done in G93 (inverse time); write G94 and a feed before it", name_of_g(code)));
    }
    return true;
}

/// Computes the heights of the retract plane and the bottom.
bool DrillWords::cycle_heights(DrillCycle& plan) {
    const double offset = frame_now().offset[plan.third];
    const bool goes_on = is_cycle(modes().motion) && modes().plane == next().plane;
    if (!goes_on) next().cycle_level = plan.level;
    plan.r = next().incremental ? next().cycle_level + next().cycle_r : next().cycle_r + offset;
    plan.bottom = next().incremental ? plan.r + next().cycle_z : next().cycle_z + offset;
    if (plan.r < plan.bottom) {
        return fail_at(
            block().has('R') ? block().column[letter_index('R')] : error_column(), GrblStatus::bad_target,
            fmt::format("R is at {} = {:.6g} mm, below the bottom of the hole at {:.6g} mm; R must be above it",
                        axis_letters[plan.third], plan.r - offset, plan.bottom - offset));
    }
    plan.clear = next().retract_to_r ? plan.r : std::max(plan.r, next().cycle_level);
    return true;
}

bool DrillWords::read(std::int16_t code) {
    if (!allows(code)) return false;
    const auto& axes = plane_axes[next().plane];
    if (!in_turned_plane(code) || !spindle_turns(code) || !cycle_words(code)) return false;
    DrillCycle plan;
    if (!claim_for_g(code, letter_bit('L'))) return false;
    if (block().has('L')) {
        if (!need_integer('L', 1, max_repeats, "the number of holes")) return false;
        plan.repeats = static_cast<std::int32_t>(block()['L']);
    }
    plan.code = code;
    plan.spindle = next().spindle;
    plan.speed_rpm = next().speed_rpm;
    plan.first = axes[0];
    plan.second = axes[1];
    plan.third = axes[2];
    plan.from = travel().position();
    plan.level = travel().position()[plan.third];
    if (!cycle_heights(plan)) return false;
    plan.peck = next().cycle_q;
    plan.clearance = settings().peck_clearance_mm;
    plan.seconds = next().cycle_p;
    if (!pecks_go(plan)) return false;
    plan.pattern.path = PathControl::exact_path;
    plan.pattern.line = line_number();
    plan.pattern.kind = MoveKind::feed;
    if (next().feed == 0) return no_feed();
    plan.pattern.feed = next().feed;
    if (!cycle_within_limits(plan)) return false;
    steps().add_cycle(plan);
    return true;
}

/// Checks the first and the last hole, because all holes lie on a straight line. Computes the steps, the first hole and
/// the end.
bool DrillWords::cycle_within_limits(DrillCycle& plan) {
    plan.pattern.end = travel().position();
    if (!(frame_now().is_rotated ? cycle_places_turned(plan) : cycle_places(plan))) return false;
    const char depth = axis_letters[plan.third];
    const std::size_t r_column = block().has('R') ? block().column[letter_index('R')] : error_column();
    const std::size_t depth_column = block().has(depth) ? block().column[letter_index(depth)] : error_column();
    travel().end()[plan.third] = plan.clear;
    if (plan.clear != plan.level && !reach(plan.third, plan.clear, r_column)) return false;
    return reach(plan.third, plan.r, r_column) && reach(plan.third, plan.bottom, depth_column);
}

/// Computes the first hole and the steps in a rotated work system, G17.
bool DrillWords::cycle_places_turned(DrillCycle& plan) {
    const WorkFrame& frame = frame_now();
    Point words = next().incremental ? Point{} : frame.to_program(travel().position());
    for (int axis = 0; axis < 2; ++axis)
        if (block().has(axis_letters[axis])) words[axis] = scaled(axis_letters[axis]);
    const Point by = frame.rotate(words), to = frame.to_machine(words);
    for (int axis = 0; axis < 2; ++axis) {
        double& step = axis == 0 ? plan.step_first : plan.step_second;
        step = next().incremental ? by[axis] : 0;
        if (!next().incremental) plan.pattern.end[axis] = to[axis];
        travel().end()[axis] = plan.pattern.end[axis] + plan.repeats * step;
        if (!reach(axis, plan.pattern.end[axis] + step, error_column()) ||
            !reach(axis, travel().end()[axis], error_column()))
            return false;
    }
    return true;
}

bool DrillWords::cycle_places(DrillCycle& plan) {
    for (const int axis : {static_cast<int>(plan.first), static_cast<int>(plan.second)}) {
        const char letter = axis_letters[axis];
        if (!block().has(letter)) continue;
        const double value = scaled(letter);
        double& step = axis == plan.first ? plan.step_first : plan.step_second;
        const std::size_t column = block().column[letter_index(letter)];
        if (next().incremental)
            step = value;
        else
            plan.pattern.end[axis] = value + frame_now().offset[axis];
        travel().end()[axis] = plan.pattern.end[axis] + plan.repeats * step;
        if (!reach(axis, plan.pattern.end[axis] + step, column) || !reach(axis, travel().end()[axis], column))
            return false;
    }
    return true;
}

}  // namespace motionrack::control::gcode
