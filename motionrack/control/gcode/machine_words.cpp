// Words for the rest of the machine.
#include <fmt/format.h>

#include <motionrack/control/gcode/machine_words.hpp>
#include <motionrack/control/gcode/words.hpp>

namespace motionrack::control::gcode {

void MachineWords::apply_letters() {
    if (block().has('S')) {
        next().speed_rpm = block()['S'];
        steps().add(StepQueue::todo_spindle_speed);
    }
    if (block().has('T')) {
        next().tool_selected = static_cast<std::int32_t>(block()['T']);
        steps().add(StepQueue::todo_tool_select);
    }
}

bool MachineWords::change_tool() {
    if (next().tool_selected < 0) {
        return fail_at(block().m_column[m_tool], GrblStatus::word_missing,
                       "M6 changes to the tool selected by a T word, and none was selected; write e.g. T1 M6");
    }
    next().tool_loaded = next().tool_selected;
    steps().add(StepQueue::todo_tool_change);
    return true;
}

bool MachineWords::set_spindle(std::int16_t code) {
    next().spindle = code == 3 ? Spindle::clockwise : code == 4 ? Spindle::counter_clockwise : Spindle::off;
    steps().add(StepQueue::todo_spindle);
    return true;
}

bool MachineWords::set_coolant(std::int16_t code) {
    if (code == 7) next().mist = true;
    if (code == 8) next().flood = true;
    if (code == 9) next().mist = next().flood = false;
    steps().add(StepQueue::todo_coolant);
    return true;
}

bool MachineWords::stop(std::int16_t code) {
    steps().add_stop(code);
    return true;
}

/// Executes M48 .. M53. The machine has no spindle override or feed stop switch: their state is stored and reported.
bool MachineWords::overrides(std::int16_t code) {
    const bool takes_p = (rule_of_m(code).letters & letter_bit('P')) != 0;
    const bool on = takes_p && block().has('P') ? block()['P'] != 0 : code != 49;
    if (takes_p && !claim_for_m(code, letter_bit('P'))) return false;
    if (code == 52 && on) {
        return fail_at(
            block().m_column[m_override], GrblStatus::unsupported,
            "M52: adaptive feed needs an input that this machine does not have; leave it out (M52 P0 is accepted)");
    }
    if (code <= 50) next().feed_override = on;
    if (code <= 49 || code == 51) next().speed_override = on;
    if (code == 53) next().feed_stop = on;
    steps().add(StepQueue::todo_overrides);
    return true;
}

bool MachineWords::check_program() {
    const int code = block().m[m_program];
    const std::size_t column = block().m_column[m_program];
    if (language() != Language::program)
        return fail_at(column, GrblStatus::unsupported,
                       fmt::format("M{}: a single line has no subprograms; run the program as a file", code));
    const std::uint32_t own = letter_bit('N') | rule_of_m(code).letters;
    if (block().g_groups != 0 || block().m_groups != 1u << m_program || (block().words & ~own) != 0 ||
        !block().assignments.empty()) {
        return fail_at(
            column, GrblStatus::unsupported,
            code == 98
                ? "M98 needs a line with only its P and L, e.g. M98 P100 L3; put the other words on a separate line"
                : "M99 needs a line of its own; put the other words on a separate line (it returns to the line of M98, "
                  "not to a line)");
    }
    use(own);
    if (code == 99) return true;
    if (!block().has('P'))
        return fail_at(
            column, GrblStatus::word_missing,
            "P word missing: M98 needs the number of a program; write e.g. M98 P100 (and O100 .. M99 behind M2)");
    return need_integer('P', 0, 1e9, "the number of a program") &&
           (!block().has('L') || need_integer('L', 0, 1e9, "how often the program runs"));
}

/// Executes M61 Q: corrects the number of the tool in the spindle.
bool MachineWords::set_tool() {
    if (!block().has('Q'))
        return fail_at(block().m_column[m_tool], GrblStatus::word_missing,
                       "Q word missing: M61 needs the number of the tool in the spindle; write e.g. M61 Q3");
    if (!need_integer('Q', 0, largest_tool, "a tool number")) return false;
    const auto number = static_cast<std::int32_t>(block()['Q']);
    if (!require_tool('Q', number) || !claim_for_m(61, letter_bit('Q'))) return false;
    next().tool_loaded = number;
    steps().add(StepQueue::todo_tool_change);
    return true;
}

bool MachineWords::save_modes(std::int16_t code) {
    in_.modes.save(code, static_cast<std::size_t>(in_.parameters.level()));
    return true;
}

bool MachineWords::restore_saved() {
    const ModalState* saved = in_.modes.saved(static_cast<std::size_t>(in_.parameters.level()));
    if (saved == nullptr)
        return fail_at(block().m_column[m_state], GrblStatus::unsupported,
                       "M72 has no modes to restore: none were saved in this program or sub, or M71 discarded them; "
                       "write M70 or M73 before it");
    restore(*saved);
    return true;
}

void MachineWords::restore(const ModalState& saved) {
    in_.modes.restore(saved);
    if (next().system != modes().system || offsets().is_frame_edited()) edit_frame().activate(next().system);
}

}  // namespace motionrack::control::gcode
