// What a Grbl tells of a machine, and of its wires.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <string>

namespace motionrack::grbl {

/// On its way into a hold, or simply on its way.
bool is_moving(const operate::Machine& machine);
/// A limit switch of this axis acts.
bool limit_active(operate::Machine& machine, char letter);
/// The contact that is there at this wire is open.
bool contact_open(operate::Machine& machine, const std::string& wire);
/// Something stopped the machine that nobody ordered.
bool has_alarm(const operate::Machine& machine);
/// A STOP is in force, and nothing else stopped the machine: a sender ends it with $X.
bool is_stop_ordered(operate::Machine& machine);
/// ALARM:N of a machine that stopped by itself.
int alarm_of_stop(operate::Machine& machine);
/// Along the path, mm/min; degrees/min where only rotary axes move.
double feed_now(const operate::Machine& machine);

}  // namespace motionrack::grbl
