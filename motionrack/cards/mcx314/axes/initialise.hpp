// Initialisation common to all axes of the chip.
#pragma once

#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/control/limits.hpp>

namespace motionrack::mcx314 {

/// Bits of WR2 that enable both software limits.
inline constexpr unsigned software_limits = field("WR2", "SLMTP").mask | field("WR2", "SLMTM").mask;

/// Initialises the whole chip: reset, pulse and direction, limit switches that act Low and decelerate, no pulses
/// reserved for the end of a drive.
Result<void> prepare_chip(Driver& driver);

/// Writes the ends of the travel to COMP+ and COMP- for the software limits; the limits stay disabled.
Result<void> write_travel(Driver& driver, int channel, const control::AxisLimits& limits);

}  // namespace motionrack::mcx314
