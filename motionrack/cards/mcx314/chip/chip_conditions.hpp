// Conditions, such as an ignored command, that the chip reports to the user.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>

namespace motionrack::mcx314 {

/// Codes of the reported conditions; `a` and `b` are the two numbers of the report.
enum ChipCondition : std::uint16_t {
    drive_ignored = 1,    ///< a: command, b: axis that is driving
    path_ignored = 2,     ///< a: command; queue full, axis busy or named twice
    unknown_command = 3,  ///< a: command, b: 1 if the MCX314As has it
    pattern_full = 4,     ///< command 38h while the stack already has three words
    pattern_ran_out = 5,  ///< a: basic pulses made; the bit pattern ended without its end code
    step_ignored = 6,     ///< command 3Ah while no segment waits for a step
    output_held = 7       ///< a: 3 (WR3) or 4 (WR4), b: bits of the outputs that stay low since a stop cleared them
};

/// Returns the message for a condition that the chip `card` has reported.
std::string describe(const sim::Condition& condition, const std::string& card);

}  // namespace motionrack::mcx314
