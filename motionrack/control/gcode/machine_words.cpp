// Words for the rest of the machine: spindle, coolant, tool, overrides, stops, and saved modes.
#include <fmt/format.h>

#include <motionrack/control/gcode/interpreter.hpp>

namespace motionrack::control::gcode {

bool Interpreter::apply_machine_words() {
    if (block().has('S')) {
        next().speed_rpm = block()['S'];
        steps_.add(StepQueue::todo_spindle_speed);
    }
    if (block().has('T')) {
        next().tool_selected = static_cast<std::int32_t>(block()['T']);
        steps_.add(StepQueue::todo_tool_select);
    }
    if (block().has_m(m_tool) && block().m[m_tool] == 61) {
        if (!set_tool()) return false;
    } else if (block().has_m(m_tool)) {
        if (next().tool_selected < 0) {
            return words_.fail_at(
                block().m_column[m_tool], GrblStatus::word_missing,
                "M6 changes to the tool selected by a T word, and none was selected; write e.g. T1 M6");
        }
        next().tool_loaded = next().tool_selected;
        steps_.add(StepQueue::todo_tool_change);
    }
    if (block().has_m(m_spindle)) {
        const int code = block().m[m_spindle];
        next().spindle = code == 3 ? Spindle::clockwise : code == 4 ? Spindle::counter_clockwise : Spindle::off;
        steps_.add(StepQueue::todo_spindle);
    }
    if (block().has_m(m_mist)) next().mist = true;
    if (block().has_m(m_flood)) next().flood = true;
    if (block().has_m(m_coolant_off)) next().mist = next().flood = false;
    if ((block().m_groups & (1u << m_mist | 1u << m_flood | 1u << m_coolant_off)) != 0)
        steps_.add(StepQueue::todo_coolant);
    if (block().has_m(m_override) && !overrides()) return false;
    if (block().has_m(m_state) && block().m[m_state] == 72) {
        if (const ModalState* saved = modes_.saved(static_cast<std::size_t>(parameters_.level()))) restore(*saved);
    }
    if (block().has_m(m_stop)) {
        steps_.add_stop(block().m[m_stop]);
    }
    return true;
}

/// M48 .. M53. The machine has no spindle override or feed stop switch: their state is stored and reported.
bool Interpreter::overrides() {
    const int code = block().m[m_override];
    const bool takes_p = code >= 50;
    const bool on = takes_p && block().has('P') ? block()['P'] != 0 : code != 49;
    if (takes_p) words_.use(letter_bit('P'));
    if (code == 52 && on) {
        return words_.fail_at(
            block().m_column[m_override], GrblStatus::unsupported,
            "M52: adaptive feed needs an input that this machine does not have; leave it out (M52 P0 is accepted)");
    }
    if (code <= 50) next().feed_override = on;
    if (code <= 49 || code == 51) next().speed_override = on;
    if (code == 53) next().feed_stop = on;
    steps_.add(StepQueue::todo_overrides);
    return true;
}

/// M98 P L and M99 must be alone on the line; ProgramFlow executes them.
bool Interpreter::program_words() {
    const int code = block().m[m_program];
    const std::size_t column = block().m_column[m_program];
    if (words_.language() != Language::program)
        return words_.fail_at(column, GrblStatus::unsupported,
                              fmt::format("M{}: a single line has no subprograms; run the program as a file", code));
    const std::uint32_t own = letter_bit('N') | (code == 98 ? letter_bit('P') | letter_bit('L') : 0u);
    if (block().g_groups != 0 || block().m_groups != 1u << m_program || (block().words & ~own) != 0 ||
        !block().assignments.empty()) {
        return words_.fail_at(
            column, GrblStatus::unsupported,
            code == 98
                ? "M98 needs a line with only its P and L, e.g. M98 P100 L3; put the other words on a separate line"
                : "M99 needs a line of its own; put the other words on a separate line (it returns to the line of M98, "
                  "not to a line)");
    }
    words_.use(own);
    if (code == 99) return true;
    if (!block().has('P'))
        return words_.fail_at(
            column, GrblStatus::word_missing,
            "P word missing: M98 needs the number of a program; write e.g. M98 P100 (and O100 .. M99 behind M2)");
    return words_.need_integer('P', 0, 1e9, "the number of a program") &&
           (!block().has('L') || words_.need_integer('L', 0, 1e9, "how often the program runs"));
}

/// M61 Q: corrects the number of the tool in the spindle.
bool Interpreter::set_tool() {
    if (!block().has('Q'))
        return words_.fail_at(block().m_column[m_tool], GrblStatus::word_missing,
                              "Q word missing: M61 needs the number of the tool in the spindle; write e.g. M61 Q3");
    if (!words_.need_integer('Q', 0, largest_tool, "a tool number")) return false;
    const auto number = static_cast<std::int32_t>(block()['Q']);
    if (!require_tool('Q', number)) return false;
    words_.use(letter_bit('Q'));
    next().tool_loaded = number;
    steps_.add(StepQueue::todo_tool_change);
    return true;
}

/// Without a tool table every number is valid.
bool Interpreter::require_tool(char letter, std::int32_t number) {
    if (number == 0 || settings_.tools.empty() || tools().find(number)) return true;
    return words_.fail_word(
        letter, GrblStatus::unsupported,
        fmt::format("{}: the tool table has no tool {}; write it into the table", words_.word_text(letter), number));
}

/// Restores modes that M70 or M73 saved.
void Interpreter::restore(const ModalState& saved) {
    modes_.restore(saved);
    if (next().system != modes().system || offsets_.is_frame_edited()) edit_frame().activate(next().system);
}

bool Interpreter::end_call(std::optional<double> returned) {
    const auto level = static_cast<std::size_t>(parameters_.level());
    parameters_.leave(returned);
    const std::optional<ModalState> kept = modes_.leave_call(level);
    if (!kept) return true;
    if (modes().cutter != CutterSide::off && !modes_.can_stay_beside(*kept)) return false;
    modes_.begin_line();
    offsets_.begin_line();
    restore(*kept);
    modes_.commit();
    offsets_.commit();
    return true;
}

void Interpreter::reset_after_program() {
    modes_.enable_overrides();
    offsets_.reset_rotation(modes().system);
}

}  // namespace motionrack::control::gcode
