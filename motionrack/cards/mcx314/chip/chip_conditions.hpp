// Conditions that the chip reports to the user.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>

namespace motionrack::mcx314 {

/// Conditions that the chip reports.
enum ChipCondition : std::uint16_t {
    drive_ignored = 1,    ///< a: command, b: axis that is driving
    path_ignored = 2,     ///< a: command; queue full, axis busy or named twice
    unknown_command = 3,  ///< a: command, b: 1 if the MCX314As has it
    pattern_full = 4,     ///< 38h with three words stacked
    pattern_ran_out = 5,  ///< a: basic pulses made; the bit pattern ended without its end code
    step_ignored = 6,     ///< 3Ah without a segment that waits for a step
    output_held = 7       ///< a: 3 or 4, the number of WR, b: bits of outputs that a stop cleared, and that stay low
};

/// Message of a condition that a chip has reported.
std::string describe(const sim::Condition& condition, const std::string& card);

}  // namespace motionrack::mcx314
