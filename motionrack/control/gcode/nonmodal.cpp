// G codes that act once: dwell, the shift G92 and reference points (G28, G30).
#include <fmt/format.h>

#include <bit>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/interpreter.hpp>

namespace motionrack::control::gcode {

bool Interpreter::nonmodal() {
    const std::int16_t code = block().g[g_nonmodal];
    switch (code) {
        case 40:
            return dwell();
        case 100:
            return set_offsets();
        case 280:
        case 300:
            return reference();
        case 281:
            edit_frame().g28 = travel_.position();
            break;
        case 301:
            edit_frame().g30 = travel_.position();
            break;
        case 920:
            return shift();
        case 921: {
            WorkFrame& frame = edit_frame();
            frame.g92 = frame.g92_saved = Point{};
            frame.activate(next().system);
            break;
        }
        case 922: {
            WorkFrame& frame = edit_frame();
            frame.g92 = Point{};
            frame.activate(next().system);
            break;
        }
        case 923: {
            WorkFrame& frame = edit_frame();
            frame.g92 = frame.g92_saved;
            frame.activate(next().system);
            break;
        }
        default:
            return true;  // G53 belongs to the motion
    }
    if ((block().words & axis_words) != 0 && !block().has_g(g_motion)) {
        const char letter = static_cast<char>('A' + std::countr_zero(block().words & axis_words));
        return words_.fail_word(letter, GrblStatus::axis_words_unused,
                                fmt::format("{}: {} takes no axis words; put the move on a separate line",
                                            words_.word_text(letter), name_of_g(code)));
    }
    return true;
}

bool Interpreter::dwell() {
    if (!block().has('P')) {
        return words_.fail_at(block().g_column[g_nonmodal], GrblStatus::word_missing,
                              "P word missing: G4 needs a time in seconds; write e.g. G4 P0.5");
    }
    words_.use(letter_bit('P'));
    steps_.add_dwell(block()['P']);
    return true;
}

bool Interpreter::shift() {
    if (words_.axis_words_taken() || (block().words & axis_words) == 0) {
        return words_.fail_at(
            block().g_column[g_nonmodal], GrblStatus::no_axis_words,
            "axis words missing: G92 needs at least one of its own; write e.g. G92 X0 Y0 (G92.1 ends the shift)");
    }
    WorkFrame& frame = edit_frame();
    const Point shifted_before = frame.g92;
    frame.g92 = {};
    frame.activate(next().system);
    const Point unshifted = frame.to_program(travel_.position());
    frame.g92 = shifted_before;
    for (int axis = 0; axis < axis_count; ++axis) {
        if ((block().words & letter_bit(axis_letters[axis])) == 0) continue;
        frame.g92[axis] = unshifted[axis] - block().value[axis_letter(axis)] * scale_of(axis);
    }
    frame.g92_saved = frame.g92;
    frame.activate(next().system);
    words_.take_axis_words();
    return true;
}

bool Interpreter::reference() {
    if (words_.axis_words_taken()) {
        return words_.fail_at(block().g_column[g_nonmodal], GrblStatus::axis_conflict,
                              fmt::format("{} and {} on one line both use axis words; put them on two lines",
                                          name_of_g(block().g[g_nonmodal]), name_of_g(block().g[g_tool_length])));
    }
    const std::uint32_t axes = block().words & axis_words;
    if (axes != 0 && !targets(false)) return false;
    const Point via = travel_.end();
    const Point& home = block().g[g_nonmodal] == 280 ? frame_now().g28 : frame_now().g30;
    const std::size_t column = block().g_column[g_nonmodal];
    for (int axis = 0; axis < axis_count; ++axis) {
        const std::uint32_t bit = letter_bit(axis_letters[axis]);
        if ((travel_.present_words() & bit) == 0 || (axes != 0 && (axes & bit) == 0)) continue;
        if (!reach(axis, home[axis], column)) return false;
        travel_.end()[axis] = home[axis];
    }
    begin_move(MoveKind::rapid);
    if (axes != 0)
        steps_.add_move_via(via);
    else
        steps_.add_move();
    words_.take_axis_words();
    return true;
}

}  // namespace motionrack::control::gcode
