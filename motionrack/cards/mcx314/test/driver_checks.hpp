// Checks of the function library's results and of the pulses.
#pragma once

#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/test/driver_rig.hpp>

namespace motionrack::mcx314 {

inline constexpr Duration max_wait = whole_seconds(60);

inline void done(const Result<void>& result) {
    ASSERT_TRUE(result) << result.error().message;
}

/// Pulses/s between the last pulses of an axis.
inline double last_rate(const outside::EdgeLog& log, std::size_t pulses) {
    const auto& list = log.list;
    const std::int64_t ticks = list.back().tick - list[list.size() - 1 - pulses].tick;
    return static_cast<double>(pulses) * 8e6 / static_cast<double>(ticks);
}

}  // namespace motionrack::mcx314
