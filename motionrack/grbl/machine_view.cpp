#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <motionrack/grbl/machine_view.hpp>
#include <motionrack/grbl/numbers.hpp>

namespace motionrack::grbl {

using operate::MachineState;

bool is_moving(const operate::Machine& machine) {
    const MachineState state = machine.state();
    return state == MachineState::moving || state == MachineState::stopping || state == MachineState::jogging;
}

bool is_settled(const operate::Machine& machine) {
    const MachineState state = machine.state();
    return !machine.conditions().has_pending() && state != MachineState::stopping && state != MachineState::homing;
}

/// Returns true if a contact exists at this wire and is open, as a contact is that acts.
bool contact_open(operate::Machine& machine, const std::string& wire) {
    const Result<double> level = machine.wires().get(wire);
    return level && *level == 0;
}

bool limit_active(operate::Machine& machine, char letter) {
    return contact_open(machine, fmt::format("{}.limit_minus", letter)) ||
           contact_open(machine, fmt::format("{}.limit_plus", letter));
}

bool is_stop_pending(operate::Machine& machine) {
    return machine.rack().stop_latch().latched() && machine.state() != MachineState::error_stop;
}

bool is_stop_ordered(operate::Machine& machine) {
    return machine.rack().stop_latch().is_ordered();
}

bool is_plain_stop(operate::Machine& machine) {
    // An alarm of the error stop has its sentence; others are about a door, an earlier run or the journal.
    return is_stop_ordered(machine) && std::ranges::none_of(machine.status().alarms, [&](const operate::Alarm& alarm) {
               return alarm.active && alarm.text == machine.status().reason;
           });
}

int alarm_of_stop(operate::Machine& machine) {
    for (const rack::RackAxis& axis : machine.rack().config().axes)
        if (limit_active(machine, axis.letter)) return alarm_hard_limit;
    return alarm_reset;
}

int alarm_of_homing(operate::Machine& machine) {
    if (machine.manual().last_homing()->ended.error().kind == ErrorKind::stopped) return alarm_homing_reset;
    for (const rack::HomedAxis& axis : machine.manual().last_homing()->axes)
        if (axis.begun && !axis.outcome.homed)
            return axis.outcome.edges.empty() ? alarm_homing_no_switch : alarm_homing_pull_off;
    return alarm_homing_no_switch;
}

double feed_now(const operate::Machine& machine) {
    double linear = 0, rotary = 0;
    for (const operate::AxisStatus& axis : machine.status().axes)
        (axis.rotary ? rotary : linear) += axis.velocity * axis.velocity;
    return std::sqrt(linear > 0 ? linear : rotary) * 60;
}

}  // namespace motionrack::grbl
