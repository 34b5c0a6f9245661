// Conditions that a simulated axis reports to the kernel, and their messages.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::parts {

enum class AxisCondition : std::uint16_t {
    fell_out_of_step = 1,  ///< a: the pulse rate before, b: after, Hz to the nearest whole, signed
    lost_steps = 2,        ///< a: pulses lost this time (signed: pulses - rotor), b: total
    end_of_travel = 3,     ///< a: +1 or -1, b: rotor in microsteps
    axle_held = 4,         ///< fault: a: rotor in microsteps
    stage_end = 5,         ///< a: +1 or -1, b: nm
    scale_too_fast = 6,    ///< a: counts/s, b: the highest rate that is counted
    scale_lost = 7         ///< a: counts lost this time, b: total
};

/// Message of a condition: "axis X lost 64 pulses (64 in all) ...". `axis`: name of the machine.
std::string describe(const sim::Condition& condition, std::string_view axis);

}  // namespace motionrack::parts
