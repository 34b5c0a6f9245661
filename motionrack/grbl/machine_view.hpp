// State of a machine and its wires as reported by Grbl.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <string>

namespace motionrack::grbl {

/// Returns true while the machine moves, including the deceleration into a hold.
bool is_moving(const operate::Machine& machine);
/// Returns true if the machine is not stopping or homing, and no stop or set position is pending.
bool is_settled(const operate::Machine& machine);
/// Returns true while a limit switch of this axis is active.
bool limit_active(operate::Machine& machine, char letter);
/// Returns true if a contact exists at this wire and is open.
bool contact_open(operate::Machine& machine, const std::string& wire);
/// Returns true if a stop is in force that the machine has not carried out yet.
bool is_stop_pending(operate::Machine& machine);
/// Returns true if a STOP is in force and was the only cause: a sender ends it with $X.
bool is_stop_ordered(operate::Machine& machine);
/// Returns true in the error stop of such a STOP that raised no alarm, as it does if a position is lost.
bool is_plain_stop(operate::Machine& machine);
/// Returns N of ALARM:N for a machine that stopped by itself.
int alarm_of_stop(operate::Machine& machine);
/// Returns N of ALARM:N for a homing that has failed. Requires one.
int alarm_of_homing(operate::Machine& machine);
/// Returns the velocity along the path, mm/min; degrees/min if only rotary axes move.
double feed_now(const operate::Machine& machine);

}  // namespace motionrack::grbl
