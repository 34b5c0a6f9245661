#include <motionrack/grbl/machine_view.hpp>
#include <motionrack/grbl/realtime_commands.hpp>

namespace motionrack::grbl {

using operate::MachineState;

std::optional<ResetCause> RealtimeCommands::act(Realtime what) {
    const operate::Status& status = on_.machine.status();
    if (what != Realtime::status) on_.reports.answer_request();
    switch (what) {
        case Realtime::status:
            on_.reports.request_status();
            break;
        case Realtime::reset:
            return ResetCause::requested;
        case Realtime::feed_hold:
            return hold();
        case Realtime::door:
            return open_door();
        case Realtime::jog_cancel:
            if (is_jogging()) on_.machine.cancel();
            break;
        case Realtime::cycle_start:
            resume();
            break;
        case Realtime::spindle_stop:
            stop_spindle();
            break;
        case Realtime::flood:
            if (may_switch_coolant()) switch_coolant(status.mist, !status.flood);
            break;
        case Realtime::mist:
            if (may_switch_coolant()) switch_coolant(!status.mist, status.flood);
            break;
        default:
            if (is_override(what) && control()) on_.overrides.change(what);
            break;
    }
    return std::nullopt;
}

void RealtimeCommands::stop_spindle() {
    if (on_.state.now() != State::hold || on_.machine.status().spindle == control::gcode::Spindle::off || !control())
        return;
    on_.overrides.toggle_spindle_stop();
    on_.reports.repeat_overrides();
}

bool RealtimeCommands::may_switch_coolant() {
    const State now = on_.state.now();
    return (now == State::idle || now == State::run || now == State::hold) && control();
}

void RealtimeCommands::switch_coolant(bool mist, bool flood) {
    on_.machine.set_coolant(mist, flood);
    on_.reports.repeat_overrides();
}

bool RealtimeCommands::is_jogging() const {
    return on_.machine.state() == MachineState::jogging || on_.state.now() == State::jog;
}

/// Holds a moving machine, for any client and in any state of this session: a stop needs no permission.
std::optional<ResetCause> RealtimeCommands::hold() {
    const State now = on_.state.now();
    if (on_.machine.state() == MachineState::homing) return ResetCause::implicit;
    if (is_jogging())
        on_.machine.cancel();
    else if (now == State::idle)
        on_.state.hold(true);
    else if (now == State::run)
        on_.state.hold(on_.machine.hold().has_value());
    else if (on_.machine.state() == MachineState::moving)
        (void)on_.machine.hold();
    return std::nullopt;
}

/// Executes the door byte: holds motion, as hold(), until the sender resumes. No contact is read, so the door counts as
/// closed.
std::optional<ResetCause> RealtimeCommands::open_door() {
    const State now = on_.state.now();
    if (on_.machine.state() == MachineState::homing) return ResetCause::door;
    if (is_jogging()) on_.machine.cancel();
    if (on_.machine.state() == MachineState::moving) (void)on_.machine.hold();
    if (now == State::alarm || now == State::check || now == State::sleep || now == State::door) return std::nullopt;
    on_.answers.push("Check Door");
    on_.state.open_door();
    return std::nullopt;
}

void RealtimeCommands::resume() {
    const State now = on_.state.now();
    if ((now != State::hold && now != State::door) || is_moving(on_.machine) || !control()) return;
    on_.state.end_hold();
    on_.overrides.end_spindle_stop();
    on_.reports.repeat_overrides();
    if (on_.machine.state() == MachineState::hold) (void)on_.machine.resume();
}

}  // namespace motionrack::grbl
