// G codes that act once.
#include <fmt/format.h>

#include <bit>
#include <motionrack/control/gcode/codes.hpp>
#include <motionrack/control/gcode/nonmodal_words.hpp>

namespace motionrack::control::gcode {

bool NonmodalWords::takes_no_axis_words() {
    if ((block().words & axis_words) == 0 || block().has_g(g_motion)) return true;
    const char letter = static_cast<char>('A' + std::countr_zero(block().words & axis_words));
    return fail_word(letter, GrblStatus::axis_words_unused,
                     fmt::format("{}: {} takes no axis words; put the move on a separate line", word_text(letter),
                                 name_of_g(block().g[g_nonmodal])));
}

bool NonmodalWords::store_first_reference() {
    edit_frame().g28 = travel().position();
    return takes_no_axis_words();
}

bool NonmodalWords::store_second_reference() {
    edit_frame().g30 = travel().position();
    return takes_no_axis_words();
}

bool NonmodalWords::forget_shift() {
    WorkFrame& frame = edit_frame();
    frame.g92 = frame.g92_saved = Point{};
    frame.activate(next().system);
    return takes_no_axis_words();
}

bool NonmodalWords::suspend_shift() {
    WorkFrame& frame = edit_frame();
    frame.g92 = Point{};
    frame.activate(next().system);
    return takes_no_axis_words();
}

bool NonmodalWords::restore_shift() {
    WorkFrame& frame = edit_frame();
    frame.g92 = frame.g92_saved;
    frame.activate(next().system);
    return takes_no_axis_words();
}

bool NonmodalWords::dwell() {
    if (!block().has('P')) {
        return fail_at(block().g_column[g_nonmodal], GrblStatus::word_missing,
                       "P word missing: G4 needs a time in seconds; write e.g. G4 P0.5");
    }
    if (!claim_for_g(block().g[g_nonmodal], letter_bit('P'))) return false;
    steps().add_dwell(block()['P']);
    return true;
}

bool NonmodalWords::shift() {
    if (axis_words_taken() || (block().words & axis_words) == 0) {
        return fail_at(
            block().g_column[g_nonmodal], GrblStatus::no_axis_words,
            "axis words missing: G92 needs at least one of its own; write e.g. G92 X0 Y0 (G92.1 ends the shift)");
    }
    WorkFrame& frame = edit_frame();
    const Point shifted_before = frame.g92;
    frame.g92 = {};
    frame.activate(next().system);
    const Point unshifted = frame.to_program(travel().position());
    frame.g92 = shifted_before;
    for (int axis = 0; axis < axis_count; ++axis) {
        if ((block().words & letter_bit(axis_letters[axis])) == 0) continue;
        frame.g92[axis] = unshifted[axis] - block().value[axis_letter(axis)] * scale_of(axis);
    }
    frame.g92_saved = frame.g92;
    frame.activate(next().system);
    take_axis_words();
    return true;
}

bool NonmodalWords::move_to_reference() {
    if (axis_words_taken()) {
        return fail_at(block().g_column[g_nonmodal], GrblStatus::axis_conflict,
                       fmt::format("{} and {} on one line both use axis words; put them on two lines",
                                   name_of_g(block().g[g_nonmodal]), name_of_g(block().g[g_tool_length])));
    }
    const std::uint32_t axes = block().words & axis_words;
    if (axes != 0 && !targets(false)) return false;
    const Point via = travel().end();
    const Point& home = block().g[g_nonmodal] == 280 ? frame_now().g28 : frame_now().g30;
    const std::size_t column = block().g_column[g_nonmodal];
    for (int axis = 0; axis < axis_count; ++axis) {
        const std::uint32_t bit = letter_bit(axis_letters[axis]);
        if ((travel().present_words() & bit) == 0 || (axes != 0 && (axes & bit) == 0)) continue;
        if (!reach(axis, home[axis], column)) return false;
        travel().end()[axis] = home[axis];
    }
    begin_move(MoveKind::rapid);
    if (axes != 0)
        steps().add_move_via(via);
    else
        steps().add_move();
    take_axis_words();
    return true;
}

}  // namespace motionrack::control::gcode
