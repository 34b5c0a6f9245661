// What all axes of the chip begin with.
#pragma once

#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/control/limits.hpp>

namespace motionrack::mcx314 {

/// WR2: both software limits in force.
inline constexpr unsigned software_limits = field("WR2", "SLMTP").mask | field("WR2", "SLMTM").mask;

/// The whole chip, once: reset, pulse and direction, limit switches that act Low and slow down, nothing kept for the
/// end of drives.
Result<void> prepare_chip(Driver& driver);

/// The ends of the travel to COMP+ and COMP-, where the software limits are; they are not in force yet.
Result<void> write_travel(Driver& driver, int channel, const control::AxisLimits& limits);

}  // namespace motionrack::mcx314
