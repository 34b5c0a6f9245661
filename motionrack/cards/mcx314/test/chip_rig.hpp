// Runs register programs on the event-driven chip, each in a kernel of its own.
#pragma once

#include <motionrack/cards/mcx314/test/rig.hpp>

namespace motionrack::mcx314::twin {

Outcome run_on_chip(const Program& program);
void run_both(const Program& program, oracle::Comparison& both);

}  // namespace motionrack::mcx314::twin
