// Refusals of the function library that are independent of a driver.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/cards/mcx314/driver/parameters.hpp>
#include <motionrack/cards/mcx314/driver/status.hpp>

namespace motionrack::mcx314 {

/// Refuses a mask that names no axes; `who`: function in the message.
Result<void> check_axes(unsigned axes, const char* who);

/// Refuses a value outside the range of its parameter, and a mask that names no axes.
Result<void> check(unsigned axes, const Parameter& parameter, std::int64_t value);

/// Refuses an `n` that is not 0 .. `max_n`; `who`: function in the message.
Result<void> check_switch(const char* who, int n, int max_n, const char* meanings);

/// Refuses while an interpolation runs.
Result<void> check_no_path(const char* who, MainStatus main);

}  // namespace motionrack::mcx314
