// Real-time bytes, and spontaneous changes of the machine.
#include <fmt/format.h>

#include <algorithm>
#include <motionrack/grbl/grbl_session.hpp>
#include <motionrack/grbl/machine_view.hpp>

namespace motionrack::grbl {

using operate::MachineState;

namespace {

constexpr std::string_view banner = "\r\nGrbl 1.1h ['$' for help]\r\n";

}  // namespace

void GrblSession::act(Realtime what) {
    const operate::Status& status = machine_.status();
    if (what != Realtime::status) reports_.answer_request();
    switch (what) {
        case Realtime::status:
            reports_.request_status();
            return;
        case Realtime::reset:
            return reset(true);
        case Realtime::feed_hold:
            return hold();
        case Realtime::door:
            return open_door();
        case Realtime::jog_cancel:
            if (state() == State::jog) machine_.cancel();
            return;
        case Realtime::cycle_start:
            return resume();
        case Realtime::spindle_stop:
            if (state() == State::hold && status.spindle != control::gcode::Spindle::off &&
                take_control(settings_, answers_)) {
                overrides_.toggle_spindle_stop();
                reports_.repeat_overrides();
            }
            return;
        case Realtime::flood:
            if (may_switch_coolant()) switch_coolant(status.mist, !status.flood);
            return;
        case Realtime::mist:
            if (may_switch_coolant()) switch_coolant(!status.mist, status.flood);
            return;
        default:
            if (is_override(what) && take_control(settings_, answers_)) overrides_.change(what);
            return;
    }
}

bool GrblSession::may_switch_coolant() {
    const State now = state();
    return (now == State::idle || now == State::run || now == State::hold) && take_control(settings_, answers_);
}

void GrblSession::switch_coolant(bool mist, bool flood) {
    machine_.set_coolant(mist, flood);
    reports_.repeat_overrides();
}

// ---- hold, door, reset

void GrblSession::hold() {
    switch (state()) {
        case State::idle:
            state_.hold(true);
            break;
        case State::run:
            state_.hold(machine_.hold().has_value());
            break;
        case State::jog:
            machine_.cancel();
            break;
        case State::home:
            reset();
            break;
        default:
            break;
    }
}

/// The machine has no door: it counts as closed again immediately, and the sender resumes.
void GrblSession::open_door() {
    const State now = state();
    if (now == State::home) {
        homing_alarm_ = alarm_homing_door;
        return reset();
    }
    if (now == State::alarm || now == State::check || now == State::sleep || now == State::door) return;
    answers_.push("Check Door");
    if (now == State::jog) machine_.cancel();
    if (now == State::run) (void)machine_.hold();
    state_.open_door();
}

void GrblSession::resume() {
    const State now = state();
    if ((now != State::hold && now != State::door) || is_moving(machine_) || !take_control(settings_, answers_)) return;
    state_.end_hold();
    overrides_.end_spindle_stop();
    reports_.repeat_overrides();
    if (machine_.state() == MachineState::hold) (void)machine_.resume();
}

/// Motion of another client continues, unless the settings say otherwise. A stop in force ends only with a reset that
/// the sender requests, not with an implicit reset of the Grbl.
void GrblSession::reset(bool is_asked_for) {
    const MachineState state = machine_.state();
    const bool is_stationary = operate::idle(state), latched = machine_.rack().stop_latch().latched();
    const Result<void> may = is_stationary || !settings_.may_stop ? Result<void>() : settings_.may_stop();
    const int number = state == MachineState::homing ? homing_alarm_ : is_moving(machine_) ? alarm_reset : alarm_none;
    if (may && number != alarm_none) alarm(number, false);
    homing_alarm_ = alarm_homing_reset;
    if (doing_) finish_answer(error_none);
    reader_.clear();
    gcode_.reset();
    state_.reset();
    overrides_.reset_spindle();
    if (may && (is_asked_for || !latched)) {
        machine_.set_overrides(1, 1);
        resets_ = true;
        machine_.reset(is_stationary && !latched ? operate::StopOrigin{} : settings_.source("^X"));
        resets_ = false;
    }
    begin_again(true);
    if (!may) answers_.push(may.error().message);
}

void GrblSession::begin_again(bool after_reset) {
    reports_.repeat_all();
    answers_.put(banner);
    if (boot_ != Boot::reset) boot_ = after_reset ? Boot::reset : Boot::greeting;
}

// ---- changes of the machine

void GrblSession::watch_machine() {
    state_.watch_machine();
    gcode_.drop_executed_n_words();
    const control::ProbeReport& probe = machine_.stream().last_probe();
    const bool probed = reports_.report_probe();
    if (state_.enters_error_stop() && !(state_.is_stopped() && !has_alarm(machine_)) &&
        !(doing_ && doing_->what == PendingLine::What::homing)) {
        state_.end_hold();
        alarm(probed && probe.failed() ? (probe.begun ? alarm_probe_contact : alarm_probe_initial)
                                       : alarm_of_stop(machine_),
              true);
        answers_.push(machine_.status().reason);
    }
}

}  // namespace motionrack::grbl
