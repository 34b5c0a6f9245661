#include <motionrack/grbl/line_rules.hpp>
#include <motionrack/grbl/numbers.hpp>
#include <motionrack/grbl/system_commands.hpp>
#include <string_view>

namespace motionrack::grbl {

namespace {

constexpr std::string_view help = "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]\r\n";

}  // namespace

int SystemCommands::execute(const std::string& text) {
    const char what = text.size() > 1 ? text[1] : '\0';
    const State now = on_.state.now();
    switch (what) {
        case '\0':
            on_.answers.put(help);
            return error_none;
        case 'J':
            return jog(text);
        case '$':
            if (text.size() > 2) return error_unknown;
            if (now == State::run || now == State::hold) return error_not_idle;
            on_.sender_settings.list();
            return error_none;
        case 'G':
            if (text.size() > 2) return error_unknown;
            on_.answers.put(on_.reports.parser_state());
            return error_none;
        case 'C':
            return text.size() > 2 ? int{error_unknown} : check_mode();
        case 'X':
            return text.size() > 2 ? int{error_unknown} : unlock();
        default:
            break;
    }
    if (now != State::idle && now != State::alarm) return error_not_idle;
    return execute_at_rest(text);
}

int SystemCommands::execute_at_rest(const std::string& text) {
    switch (text[1]) {
        case '#':
            if (text.size() > 2) return error_unknown;
            on_.answers.put(on_.reports.parameters());
            return error_none;
        case 'H':
            return text.size() > 2 ? int{error_unknown} : home();
        case 'S':
            if (text != "$SLP") return error_unknown;
            on_.answers.answer(error_none);
            on_.answers.push("Sleeping");
            on_.state.sleep();
            return answer_later;
        case 'I':
            if (text.size() > 2 && text[2] != '=') return error_unknown;
            if (text.size() > 2)
                on_.sender_settings.store_build_text(text.substr(3));
            else
                on_.sender_settings.list_build();
            return error_none;
        case 'R':
            return restore(text);
        case 'N':
            if (text.size() > 2) return on_.sender_settings.store_startup_line(std::string_view(text).substr(2));
            on_.sender_settings.list_startup_lines();
            return error_none;
        default:
            return on_.sender_settings.store(std::string_view(text).substr(1));
    }
}

int SystemCommands::restore(const std::string& text) {
    if (const int error = on_.sender_settings.restore(text); error != error_none) return error;
    on_.answers.push("Restoring defaults");
    on_.answers.answer(error_none);
    return reset_now;
}

int SystemCommands::check_mode() {
    if (on_.gcode.is_checking()) {
        on_.answers.push("Disabled");
        on_.answers.answer(error_none);
        return reset_now;
    }
    if (on_.state.now() != State::idle) return error_not_idle;
    on_.gcode.begin_check();
    on_.answers.push("Enabled");
    return error_none;
}

// ---- unlock and homing

/// Executes $X: the operator confirms the displayed axis positions, which become valid.
int SystemCommands::unlock() {
    if (on_.state.now() != State::alarm) return error_none;
    if (!control()) return error_locked;
    if (on_.machine.state() == operate::MachineState::error_stop)  // after a STOP; others need the sender's reset
        on_.state.reset_machine(on_.settings.source("$X"));
    on_.state.end_alarm();
    (void)on_.state.release();
    on_.pending.begin(PendingAction::unlocking);
    return answer_later;
}

int SystemCommands::home() {
    if (!operate::can_home(on_.machine.rack().config())) return error_no_homing;
    if (!control()) return error_locked;
    (void)on_.machine.enable(true);
    if (const Result<void> begun = on_.machine.manual().home(""); !begun) {
        on_.answers.push(begun.error().message);
        return error_locked;
    }
    (void)on_.state.release();
    on_.pending.begin(PendingAction::homing);
    return answer_later;
}

// ---- jog

int SystemCommands::jog(const std::string& text) {
    const State now = on_.state.now();
    if (now != State::idle && now != State::jog) return error_not_idle;
    const JogLine line = read_jog(text, on_.gcode.interpreter(), on_.settings.axes);
    if (line.error != error_none) return line.error;
    if (!control()) return error_locked;
    on_.state.enable_new_machine();
    if (const Result<void> begun = on_.machine.manual().jog_to(line.target, line.feed); !begun) {
        on_.answers.push(begun.error().message);
        return error_locked;
    }
    return error_none;
}

}  // namespace motionrack::grbl
