// Offsets of program coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/offset_words.hpp>

namespace motionrack::control::gcode {

bool OffsetWords::set_offsets() {
    const std::size_t column = block().g_column[g_nonmodal];
    const bool by_sender = language() == Language::words;
    if (!block().has('L')) {
        return fail_at(column, GrblStatus::word_missing,
                       "L word missing: write G10 L2 P1 X.. to set G54's offset, G10 L20 P1 X.. to set the current "
                       "position in G54");
    }
    const bool of_tool = !by_sender && (block()['L'] == 1 || block()['L'] == 10 || block()['L'] == 11);
    if (!block().has('P')) {
        return fail_at(column, GrblStatus::word_missing,
                       of_tool ? "P word missing: G10 L1, L10 and L11 need the number of a tool, e.g. P3"
                               : "P word missing: G10 needs P1 (G54) to P6 (G59), or P0 for the active system");
    }
    if (of_tool) return edit_tool(static_cast<int>(block()['L']));
    if (block()['L'] != 2 && block()['L'] != 20) {
        if (!need_integer('L', 0, 1e9, "what G10 sets")) return false;
        return fail_word(
            'L', GrblStatus::unsupported,
            fmt::format("G10 {} is not supported; G10 L2 sets an offset, G10 L20 sets the position in a system{}",
                        word_text('L'), by_sender ? "" : ", G10 L1, L10 and L11 set a tool's length"));
    }
    if (!need_integer('P', 0, 1e9, "a work system (0 the active one, 1 G54 .. 6 G59)")) return false;
    if (block()['P'] > (by_sender ? grbl_work_system_count : work_offset_count)) {
        return fail_word(
            'P', GrblStatus::no_such_system,
            fmt::format("{}: the machine has {} work systems, P1 (G54) to P6 (G59), {}and P0 for the active one",
                        word_text('P'), by_sender ? "six" : "nine", by_sender ? "" : "P7 (G59.1) to P9 (G59.3), "));
    }
    if (!claim_for_g(block().g[g_nonmodal], letter_bit('L') | letter_bit('P'))) return false;
    const int number = static_cast<int>(block()['P']);
    return set_work_offset(number == 0 ? next().system : number - 1, block()['L'] == 20);
}

bool OffsetWords::set_work_offset(int system, bool from_position) {
    const bool turns = block().has('R') && !from_position && language() != Language::words;
    if ((block().words & axis_words) == 0 && !turns) {
        return fail_at(block().g_column[g_nonmodal], GrblStatus::no_axis_words,
                       "axis words missing: G10 needs at least one; write e.g. G10 L20 P1 X0 Y0");
    }
    WorkFrame& frame = edit_frame();
    const auto place = static_cast<std::size_t>(system);
    if (turns) {
        if (!claim_for_g(block().g[g_nonmodal], letter_bit('R'))) return false;
        frame.rotation_deg[place] = block()['R'];
    }
    if (from_position && frame.rotation_deg[place] != 0) {
        shift_turned(frame, system);
    } else {
        for (int axis = 0; axis < axis_count; ++axis) {
            if ((block().words & letter_bit(axis_letters[axis])) == 0) continue;
            const double value = block().value[axis_letter(axis)] * scale_of(axis);
            const double others = frame.g92[axis] + frame.tool[axis];
            frame.work[place][axis] = from_position ? travel().position()[axis] - others - value : value;
        }
    }
    frame.activate(next().system);
    take_axis_words();
    return true;
}

/// Returns the change of an offset, along the axes of the frame in machine coordinates, that makes the current position
/// read as the words.
Point OffsetWords::shift_to_words(const WorkFrame& frame) const {
    const Point now = frame.to_program(travel().position());
    Point by = {};
    for (int axis = 0; axis < axis_count; ++axis) {
        if ((block().words & letter_bit(axis_letters[axis])) == 0) continue;
        by[axis] = now[axis] - block().value[axis_letter(axis)] * scale_of(axis);
    }
    return frame.rotate(by);
}

/// Executes G10 L20 for a rotated work system.
void OffsetWords::shift_turned(WorkFrame& frame, int system) {
    frame.activate(system);
    const Point by = shift_to_words(frame);
    for (int axis = 0; axis < axis_count; ++axis) frame.work[static_cast<std::size_t>(system)][axis] += by[axis];
}

/// Executes G10 L1, L10 and L11. L1 sets the offsets of a tool as written; L10 and L11 set them so that the current
/// tool position equals the words. L10 uses the active system, L11 uses G59.3.
bool OffsetWords::edit_tool(int what) {
    if (!need_integer('P', 1, largest_tool, "the number of a tool")) return false;
    if (!claim_for_g(block().g[g_nonmodal], letter_bit('L') | letter_bit('P'))) return false;
    Tool tool;
    tool.number = static_cast<std::int32_t>(block()['P']);
    if (const Tool* known = tools().find(tool.number)) {
        tool = *known;
    } else if (tools().tools().size() >= max_tools) {
        return fail_word('P', GrblStatus::unsupported,
                         fmt::format("{}: the tool table has {} tools already", word_text('P'), max_tools));
    }
    if (what == 1) {
        for (int axis = 0; axis < axis_count; ++axis)
            if ((block().words & letter_bit(axis_letters[axis])) != 0)
                tool.offset[axis] = block().value[axis_letter(axis)] * scale_of(axis);
    } else {
        WorkFrame with = frame_now();
        with.tool = tool.offset;
        if (what == 11) with.g92 = {};
        with.activate(what == 11 ? work_offset_count - 1 : next().system);
        const Point by = shift_to_words(with);
        for (int axis = 0; axis < axis_count; ++axis) tool.offset[axis] += by[axis];
    }
    if (!edit_tool_shape(tool)) return false;
    offsets().edit_tool(tool);
    take_axis_words();
    return true;
}

bool OffsetWords::edit_tool_shape(Tool& tool) {
    const auto take = [this](char letter, double& to, double scale) {
        if (!block().has(letter)) return;
        to = block()[letter] * scale;
        use(letter_bit(letter));
    };
    if (block().has('R') && block()['R'] < 0)
        return fail_word('R', GrblStatus::negative_value,
                         fmt::format("{}: the radius of a tool is 0 or more", word_text('R')));
    take('R', tool.diameter_mm, 2 * scale_of(0));
    take('I', tool.front_angle, 1);
    take('J', tool.back_angle, 1);
    if (!block().has('Q')) return true;
    if (!need_integer('Q', 0, 9, "the orientation of a tool")) return false;
    tool.orientation = static_cast<std::int32_t>(block()['Q']);
    return claim_for_g(block().g[g_nonmodal], letter_bit('Q'));
}

bool OffsetWords::tool_length() {
    const int code = block().g[g_tool_length];
    if (code == 490) {
        WorkFrame& frame = edit_frame();
        frame.tool = {};
        frame.activate(next().system);
        return true;
    }
    if (code == 431) return tool_length_of_words(false);
    if (code == 432 && !block().has('H')) return tool_length_of_words(true);
    return tool_length_of_table(code == 432);
}

/// Executes G43.1, and G43.2 without H: the length is in the words of the line.
bool OffsetWords::tool_length_of_words(bool adds) {
    const std::uint32_t others = language() == Language::words ? block().words & axis_words & ~letter_bit('Z') : 0;
    if (others != 0) {
        const char letter = static_cast<char>('A' + std::countr_zero(others));
        return fail_word(letter, GrblStatus::tool_length_axis,
                         fmt::format("{}: the tool length is along Z only; write e.g. G43.1 Z12.5 on a line of its own",
                                     word_text(letter)));
    }
    if ((block().words & axis_words) == 0) {
        return fail_at(
            block().g_column[g_tool_length], GrblStatus::no_axis_words,
            adds ? "H word missing: G43.2 needs the number of a tool, or the length to add; write e.g. G43.2 H3"
                 : "Z word missing: G43.1 needs the length of the tool; write e.g. G43.1 Z12.5");
    }
    WorkFrame& frame = edit_frame();
    for (int axis = 0; axis < axis_count; ++axis) {
        if ((block().words & letter_bit(axis_letters[axis])) == 0) continue;
        const double value = block().value[axis_letter(axis)] * scale_of(axis);
        frame.tool[axis] = adds ? frame.tool[axis] + value : value;
    }
    frame.activate(next().system);
    take_axis_words();
    return true;
}

/// Executes G43 and G43.2 with the lengths of the table; G43 without H, or with H0, selects the tool in the spindle.
bool OffsetWords::tool_length_of_table(bool adds) {
    const std::size_t column = block().g_column[g_tool_length];
    std::int32_t number = std::max(0, next().tool_loaded);
    if (block().has('H')) {
        if (!need_integer('H', 0, largest_tool, "a tool number")) return false;
        use(letter_bit('H'));
        if (block()['H'] != 0) number = static_cast<std::int32_t>(block()['H']);
    }
    if (number != 0 && tools().empty()) {
        return fail_at(
            column, GrblStatus::unsupported,
            fmt::format("{}: the program has no tool table; give the program one (--tools FILE, tools= in Python), "
                        "or write the tool's length itself, e.g. G43.1 Z12.5",
                        name_of_g(block().g[g_tool_length])));
    }
    const Tool* tool = number == 0 ? nullptr : tool_of_table(number, 'H', g_tool_length);
    if (number != 0 && !tool) return false;
    WorkFrame& frame = edit_frame();
    const Point length = tool ? tool->offset : Point{};
    for (int axis = 0; axis < axis_count; ++axis)
        frame.tool[axis] = adds ? frame.tool[axis] + length[axis] : length[axis];
    frame.activate(next().system);
    return true;
}

}  // namespace motionrack::control::gcode
