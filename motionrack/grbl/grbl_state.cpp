#include <algorithm>
#include <motionrack/grbl/grbl_state.hpp>
#include <motionrack/grbl/machine_view.hpp>
#include <utility>

namespace motionrack::grbl {

using operate::MachineState;

GrblState::GrblState(operate::Machine& machine, const GcodeLines& gcode)
    : machine_(machine), gcode_(gcode), never_enabled_(machine.state() == MachineState::disabled) {}

State GrblState::now() const {
    const MachineState state = machine_.state();
    if (asleep_) return State::sleep;
    if (state == MachineState::homing) return State::home;
    if (critical_ || is_locked()) return State::alarm;
    if (state == MachineState::jogging || (jogging_ && state == MachineState::stopping)) return State::jog;
    if (door_) return State::door;
    if (held_ || state == MachineState::hold) return State::hold;
    if (is_moving(machine_)) return State::run;
    return gcode_.is_checking() ? State::check : State::idle;
}

bool GrblState::is_locked() const {
    const MachineState state = machine_.state();
    if (alarm_ || stopped_ || (state == MachineState::disabled && !never_enabled_)) return true;
    if (state == MachineState::error_stop || state == MachineState::service) return true;
    return std::ranges::any_of(machine_.rack().config().axes,
                               [&](const rack::RackAxis& axis) { return !machine_.position_valid(axis); });
}

void GrblState::watch_machine() {
    const MachineState state = machine_.state();
    never_enabled_ = never_enabled_ && state == MachineState::disabled;
    jogging_ = state == MachineState::jogging || (jogging_ && state == MachineState::stopping);
    if (state == MachineState::hold) {
        hold_seen_ = held_ || door_;
    } else if (hold_seen_ && state != MachineState::stopping) {
        end_hold();  // resumed or stopped by another client
    }
}

bool GrblState::enters_error_stop() {
    const bool is_stopped_now = machine_.state() == MachineState::error_stop;
    return !std::exchange(stop_reported_, is_stopped_now) && is_stopped_now;
}

/// Enables a machine that was never enabled. Called for motion commands only: connecting enables no drive.
void GrblState::enable_new_machine() {
    if (never_enabled_) (void)machine_.enable(true);
}

void GrblState::reset_machine(const operate::StopOrigin& by) {
    resets_ = true;
    machine_.reset(by);
    resets_ = false;
}

void GrblState::validate_positions() {
    for (const operate::AxisStatus& axis : machine_.status().axes)
        if (!machine_.position_valid(*machine_.rack().config().axis(axis.letter)))
            (void)machine_.manual().set_position(axis.letter, axis.commanded);
}

void GrblState::open_door() {
    door_ = true;
    held_ = false;
}

bool GrblState::lock() {
    const bool locked_before = std::exchange(stopped_, true) || critical_;
    end_hold();
    return locked_before;
}

bool GrblState::release() {
    return std::exchange(stopped_, false);
}

/// Clears holds, sleep and locks. After sleep the state is Alarm, as in Grbl.
void GrblState::reset() {
    alarm_ = alarm_ || asleep_;
    held_ = door_ = asleep_ = critical_ = stopped_ = false;
}

}  // namespace motionrack::grbl
