// Checks of results of the function library, and of pulses.
#pragma once

#include <gtest/gtest.h>

#include <motionrack/cards/mcx314/test/driver_rig.hpp>

namespace motionrack::mcx314 {

inline constexpr Duration max_wait = whole_seconds(60);

inline void done(const Result<void>& result) {
    ASSERT_TRUE(result) << result.error().message;
}

/// Returns the mean rate of the last pulses of an axis, pulses/s.
inline double last_rate(const outside::EdgeLog& log, std::size_t pulses) {
    const auto& list = log.list;
    const std::int64_t ticks = list.back().tick - list[list.size() - 1 - pulses].tick;
    return static_cast<double>(pulses) * 8e6 / static_cast<double>(ticks);
}

}  // namespace motionrack::mcx314
