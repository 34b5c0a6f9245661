// $ commands, and the states in which they are accepted.
#include <motionrack/grbl/grbl_session.hpp>
#include <motionrack/grbl/line_rules.hpp>
#include <motionrack/grbl/machine_view.hpp>

namespace motionrack::grbl {

using operate::MachineState;

namespace {

constexpr std::string_view help = "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]\r\n";

}  // namespace

int GrblSession::command(const std::string& text) {
    const char what = text.size() > 1 ? text[1] : '\0';
    const State now = state();
    switch (what) {
        case '\0':
            answers_.put(help);
            return error_none;
        case 'J':
            return jog(text);
        case '$':
            if (text.size() > 2) return error_unknown;
            if (now == State::run || now == State::hold) return error_not_idle;
            sender_settings_.list();
            return error_none;
        case 'G':
            if (text.size() > 2) return error_unknown;
            answers_.put(reports_.parser_state());
            return error_none;
        case 'C':
            return text.size() > 2 ? int{error_unknown} : check_mode();
        case 'X':
            return text.size() > 2 ? int{error_unknown} : unlock();
        default:
            break;
    }
    if (now != State::idle && now != State::alarm) return error_not_idle;
    return command_at_rest(text);
}

int GrblSession::command_at_rest(const std::string& text) {
    switch (text[1]) {
        case '#':
            if (text.size() > 2) return error_unknown;
            answers_.put(reports_.parameters());
            return error_none;
        case 'H':
            return text.size() > 2 ? int{error_unknown} : home();
        case 'S':
            if (text != "$SLP") return error_unknown;
            answers_.answer(error_none);
            answers_.push("Sleeping");
            state_.sleep();
            return answer_later;
        case 'I':
            if (text.size() > 2 && text[2] != '=') return error_unknown;
            if (text.size() > 2)
                sender_settings_.store_build_text(text.substr(3));
            else
                sender_settings_.list_build();
            return error_none;
        case 'R':
            return restore(text);
        case 'N':
            if (text.size() > 2) return sender_settings_.store_startup_line(std::string_view(text).substr(2));
            sender_settings_.list_startup_lines();
            return error_none;
        default:
            return sender_settings_.store(std::string_view(text).substr(1));
    }
}

int GrblSession::restore(const std::string& text) {
    if (const int error = sender_settings_.restore(text); error != error_none) return error;
    answers_.push("Restoring defaults");
    answers_.answer(error_none);
    reset(ResetCause::implicit);
    return answer_later;
}

int GrblSession::check_mode() {
    if (gcode_.is_checking()) {
        answers_.push("Disabled");
        answers_.answer(error_none);
        reset(ResetCause::implicit);
        return answer_later;
    }
    if (state() != State::idle) return error_not_idle;
    gcode_.begin_check();
    answers_.push("Enabled");
    return error_none;
}

// ---- unlock and homing

/// The operator confirms the displayed axis positions.
int GrblSession::unlock() {
    if (state() != State::alarm) return error_none;
    if (!take_control(settings_, answers_)) return error_locked;
    if (machine_.state() == MachineState::error_stop)  // after a STOP; others need the sender's reset
        state_.reset_machine(settings_.source("$X"));
    state_.end_alarm();
    (void)state_.release();
    pending_.begin(PendingAction::unlocking);
    return answer_later;
}

int GrblSession::home() {
    if (!operate::can_home(machine_.rack().config())) return error_no_homing;
    if (!take_control(settings_, answers_)) return error_locked;
    (void)machine_.enable(true);
    if (const Result<void> begun = machine_.home(""); !begun) {
        answers_.push(begun.error().message);
        return error_locked;
    }
    (void)state_.release();
    pending_.begin(PendingAction::homing);
    return answer_later;
}

/// Axes without a switch keep their displayed positions, as after power-up of a Grbl.
bool GrblSession::finish_homing() {
    const Result<void>& ended = machine_.last_homing()->ended;
    if (ended) {
        state_.end_alarm();
        if (state_.is_locked() && pending_.begins_validation()) {
            state_.validate_positions();
            return false;
        }
        if (!state_.is_stopped()) startup();
        pending_.finish(state_.is_stopped() ? error_locked : error_none);
        return true;
    }
    if (ended.error().kind == ErrorKind::refused) {
        answers_.push(ended.error().message);
        pending_.finish(error_no_homing);
        return true;
    }
    alarm(alarm_of_homing(machine_), false);
    answers_.push(ended.error().message);
    reset(ResetCause::implicit);
    return false;
}

// ---- jog

int GrblSession::jog(const std::string& text) {
    const State now = state();
    if (now != State::idle && now != State::jog) return error_not_idle;
    const JogLine line = read_jog(text, gcode_.interpreter(), settings_.axes);
    if (line.error != error_none) return line.error;
    if (!take_control(settings_, answers_)) return error_locked;
    state_.enable_new_machine();
    if (const Result<void> begun = machine_.jog_to(line.target, line.feed); !begun) {
        answers_.push(begun.error().message);
        return error_locked;
    }
    watch_machine();
    return error_none;
}

}  // namespace motionrack::grbl
