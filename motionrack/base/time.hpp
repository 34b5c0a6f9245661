// Virtual time: whole ticks of 100 ps in 64 bits, so that every clock of every card is exact and 29 years fit.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>

namespace motionrack {

/// One tick is 100 ps: 16 MHz, 8 MHz, 100 MHz, 400 kHz, 1.2 us and 10 us are all whole numbers of ticks.
using Duration = std::chrono::duration<std::int64_t, std::ratio<1, 10'000'000'000>>;

/// An instant of virtual time, counted from the start of the rack (0).
using Instant = Duration;

/// Later than everything; "never" as an answer to "when does the next thing happen?".
inline constexpr Instant never{std::numeric_limits<std::int64_t>::max()};

constexpr Duration nanoseconds(std::int64_t n) { return Duration{n * 10}; }
constexpr Duration microseconds(std::int64_t n) { return Duration{n * 10'000}; }
constexpr Duration milliseconds(std::int64_t n) { return Duration{n * 10'000'000}; }
constexpr Duration whole_seconds(std::int64_t n) { return Duration{n * 10'000'000'000}; }

/// `by` (>= 0) after `from` (>= 0), at most `never`: the end of a wait that may be endless.
constexpr Instant later(Instant from, Duration by) { return by > never - from ? never : from + by; }

/// Seconds as a double, for people and pictures; never used to order events.
constexpr double to_seconds(Duration d) { return static_cast<double>(d.count()) * 1e-10; }

/// The nearest tick to `seconds` (range +-9.2e8 s).
constexpr Duration from_seconds(double seconds) {
    return Duration{static_cast<std::int64_t>(seconds * 1e10 + (seconds < 0 ? -0.5 : 0.5))};
}

/// A clock whose period need not be a whole number of ticks: edge n is computed from n in 128 bits, never by adding.
class ClockEdges {
  public:
    /// `hertz`: 1 .. 10'000'000'000; `origin`: the instant of edge 0.
    constexpr explicit ClockEdges(std::int64_t hertz, Instant origin = Instant{0}) : hertz_(hertz), origin_(origin) {}

    /// The instant of edge n (n >= 0), rounded down to a tick.
    constexpr Instant edge(std::int64_t n) const {
        __extension__ using Wide = __int128;
        return origin_ + Duration{static_cast<std::int64_t>(Wide{n} * 10'000'000'000 / hertz_)};
    }

    /// The number of the last edge at or before `t` (t >= origin).
    constexpr std::int64_t last_edge(Instant t) const {
        __extension__ using Wide = __int128;
        const Wide elapsed = (t - origin_).count();
        // edge(n) = floor(n * 1e10 / hertz) <= elapsed  <=>  n * 1e10 < (elapsed + 1) * hertz
        return static_cast<std::int64_t>(((elapsed + 1) * hertz_ - 1) / 10'000'000'000);
    }

  private:
    std::int64_t hertz_;
    Instant origin_;
};

}  // namespace motionrack
