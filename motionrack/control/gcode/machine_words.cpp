// Words for the rest of the machine: spindle, coolant, tool, overrides, stops, and saved modes.
#include <fmt/format.h>

#include <motionrack/control/gcode/interpreter.hpp>

namespace motionrack::control::gcode {

bool Interpreter::apply_machine_words() {
    if (block().has('S')) {
        next_.speed_rpm = block()['S'];
        todo_ |= todo_spindle_speed;
    }
    if (block().has('T')) {
        next_.tool_selected = static_cast<std::int32_t>(block()['T']);
        todo_ |= todo_tool_select;
    }
    if (block().has_m(m_tool) && block().m[m_tool] == 61) {
        if (!set_tool()) return false;
    } else if (block().has_m(m_tool)) {
        if (next_.tool_selected < 0) {
            return words_.fail_at(
                block().m_column[m_tool], GrblStatus::word_missing,
                "M6 changes to the tool selected by a T word, and none was selected; write e.g. T1 M6");
        }
        next_.tool_loaded = next_.tool_selected;
        todo_ |= todo_tool_change;
    }
    if (block().has_m(m_spindle)) {
        const int code = block().m[m_spindle];
        next_.spindle = code == 3 ? Spindle::clockwise : code == 4 ? Spindle::counter_clockwise : Spindle::off;
        todo_ |= todo_spindle;
    }
    if (block().has_m(m_mist)) next_.mist = true;
    if (block().has_m(m_flood)) next_.flood = true;
    if (block().has_m(m_coolant_off)) next_.mist = next_.flood = false;
    if ((block().m_groups & (1u << m_mist | 1u << m_flood | 1u << m_coolant_off)) != 0) todo_ |= todo_coolant;
    if (block().has_m(m_override) && !overrides()) return false;
    if (block().has_m(m_state) && block().m[m_state] == 72) {
        const auto level = static_cast<std::size_t>(parameters_.level());
        if (level < kept_.size() && kept_[level].modes) restore(*kept_[level].modes);
    }
    if (block().has_m(m_stop)) {
        stop_code_ = block().m[m_stop];
        todo_ |= todo_stop;
    }
    return true;
}

/// Applies the state after M2 and M30 that Grbl and LinuxCNC reset. Runs when the end is pulled, so that the moves
/// before it on the line keep their frame.
void Interpreter::apply_end() {
    end_pending_ = false;
    next_ = modes_;
    next_.motion = 10;
    next_.plane = 0;
    next_.incremental = next_.inverse_time = next_.arc_absolute = false;
    next_.feed = next_.feed_rotary = 0;
    next_.spindle = Spindle::off;
    next_.mist = next_.flood = false;
    next_.feed_override = next_.speed_override = true;
    next_.ended = true;
    next_.cutter = CutterSide::off;
    next_.system = 0;
    frame_.activate(next_.system);
    modes_ = next_;
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
    if (code <= 50) next_.feed_override = on;
    if (code <= 49 || code == 51) next_.speed_override = on;
    if (code == 53) next_.feed_stop = on;
    todo_ |= todo_overrides;
    return true;
}

void Interpreter::fill_overrides() {
    const int code = block().m[m_override];
    event_.kind = CanonCallKind::overrides;
    event_.port = code;
    event_.value = code == 51   ? modes_.speed_override
                   : code == 52 ? false
                   : code == 53 ? modes_.feed_stop
                                : modes_.feed_override;
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
    next_.tool_loaded = number;
    todo_ |= todo_tool_change;
    return true;
}

/// Without a tool table every number is valid.
bool Interpreter::require_tool(char letter, std::int32_t number) {
    if (number == 0 || settings_.tools.empty() || tools_.find(number)) return true;
    return words_.fail_word(
        letter, GrblStatus::unsupported,
        fmt::format("{}: the tool table has no tool {}; write it into the table", words_.word_text(letter), number));
}

/// M70 saves the modes, M71 discards them, M72 restores them, M73 saves them until the call ends. Spindle and coolant
/// are not affected.
void Interpreter::save_modes() {
    const int code = block().m[m_state];
    if (code == 72) return;
    const auto level = static_cast<std::size_t>(parameters_.level());
    if (kept_.size() <= level) kept_.resize(level + 1);
    kept_[level] = {};
    if (code != 71) kept_[level] = {modes_, code == 73};
}

void Interpreter::restore(const ModalState& saved) {
    next_.plane = saved.plane;
    next_.system = saved.system;
    next_.inch = saved.inch;
    next_.incremental = saved.incremental;
    next_.arc_absolute = saved.arc_absolute;
    next_.inverse_time = saved.inverse_time;
    next_.retract_to_r = saved.retract_to_r;
    next_.path = saved.path;
    next_.tolerance_mm = saved.tolerance_mm;
    next_.feed = saved.feed;
    next_.feed_rotary = saved.feed_rotary;
    next_.feed_override = saved.feed_override;
    next_.speed_override = saved.speed_override;
    next_.feed_stop = saved.feed_stop;
    if (next_.system != modes_.system || frame_edited_) edit_frame().activate(next_.system);
}

bool Interpreter::end_call(std::optional<double> returned) {
    const auto level = static_cast<std::size_t>(parameters_.level());
    parameters_.leave(returned);
    if (kept_.size() <= level) return true;
    const SavedModes kept = kept_[level];
    kept_.resize(level);
    if (!kept.modes || !kept.comes_back) return true;
    if (modes_.cutter != CutterSide::off && !goes_beside(*kept.modes)) return false;
    next_ = modes_;
    frame_edited_ = false;
    restore(*kept.modes);
    modes_ = next_;
    if (frame_edited_) frame_ = next_frame_;
    return true;
}

/// Returns true if cutter compensation can stay on with the restored modes.
bool Interpreter::goes_beside(const ModalState& saved) const {
    return saved.plane == modes_.plane && saved.inch == modes_.inch && saved.system == modes_.system &&
           !saved.inverse_time;
}

void Interpreter::reset_after_program() {
    modes_.feed_override = modes_.speed_override = true;
    frame_.rotation_deg = {};
    frame_.activate(modes_.system);
}

}  // namespace motionrack::control::gcode
