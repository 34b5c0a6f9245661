// Virtual time: whole ticks of 100 ps in 64 bits, so every clock of every card is exact and 29 years fit.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

namespace motionrack {

/// One tick is 100 ps: 16 MHz, 8 MHz, 100 MHz, 400 kHz, 1.2 us and 10 us are all whole numbers of ticks.
using Duration = std::chrono::duration<std::int64_t, std::ratio<1, 10'000'000'000>>;

/// An instant of virtual time, counted from the start of the rack (0).
using Instant = Duration;

/// Later than every instant; "never" as the next instant of an event.
inline constexpr Instant never{std::numeric_limits<std::int64_t>::max()};

constexpr Duration nanoseconds(std::int64_t n) {
    return Duration{n * 10};
}
constexpr Duration microseconds(std::int64_t n) {
    return Duration{n * 10'000};
}
constexpr Duration milliseconds(std::int64_t n) {
    return Duration{n * 10'000'000};
}
constexpr Duration whole_seconds(std::int64_t n) {
    return Duration{n * 10'000'000'000};
}

/// The instant `by` (>= 0) after `from` (>= 0), at most `never`: the end of a wait that may be unlimited.
constexpr Instant later(Instant from, Duration by) {
    return by > never - from ? never : from + by;
}

/// Seconds as a double, for output and charts; never used to order events.
constexpr double to_seconds(Duration d) {
    return static_cast<double>(d.count()) * 1e-10;
}

/// The nearest tick to `seconds`; `never` and -`never` beyond the range of a Duration (about 9.2e8 s), `never` for NaN.
constexpr Duration from_seconds(double seconds) {
    constexpr double beyond = 0x1p63;
    const double ticks = seconds * 1e10 + (seconds < 0 ? -0.5 : 0.5);
    if (ticks <= -beyond) return -never;
    return ticks < beyond ? Duration{static_cast<std::int64_t>(ticks)} : never;
}

}  // namespace motionrack
