// The slope table: 48 intervals of 5 bytes, deceleration 0..23 by the distance to go, acceleration 24..47 by the
// distance travelled.
//
//   rate ^        ________            entry 47 outside the table
//        |   ____|        |___
//        | _|                 |__      deceleration: entry i where the distance to go is at most its position,
//        ||                      |     acceleration: entry i where the distance travelled is below its position
//        +------------------------> position
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/cards/databoard4002/arithmetic.hpp>

namespace motionrack::databoard4002 {

/// An interval of a ramp: up to `position` counts (0 .. 16,777,215), the card drives at `rate` (0 .. 16383).
struct SlopeEntry {
    int rate = 0;
    std::int64_t position = 0;
    friend bool operator==(const SlopeEntry&, const SlopeEntry&) = default;
};

/// Flaw of a table, which the card accepts anyway: a rate of 0, positions that descend within a ramp, or a position
/// beyond the longest move.
enum class SlopeFlaw : std::uint8_t { none, speed_zero, descending, too_far };

class SlopeTable {
  public:
    static constexpr int half = 24, entries = 48, bytes_of_entry = 5;
    static constexpr int size = entries * bytes_of_entry;

    constexpr SlopeEntry entry(int i) const {
        const std::uint8_t* at = &bytes_[static_cast<std::size_t>(i) * bytes_of_entry];
        return {(at[0] | at[1] << 8) & rate_mask, at[2] | at[3] << 8 | at[4] << 16};
    }
    constexpr void set(int i, const SlopeEntry& entry) {
        std::uint8_t* at = &bytes_[static_cast<std::size_t>(i) * bytes_of_entry];
        at[0] = static_cast<std::uint8_t>(entry.rate);
        at[1] = static_cast<std::uint8_t>(entry.rate >> 8);
        for (int k = 0; k < 3; ++k) at[2 + k] = static_cast<std::uint8_t>(entry.position >> (8 * k));
    }
    constexpr std::uint8_t byte(int i) const { return bytes_[static_cast<std::size_t>(i)]; }
    constexpr void set_byte(int i, std::uint8_t value) { bytes_[static_cast<std::size_t>(i)] = value; }

    /// A rate and the distances over which it holds, counts: min <= distance <= max.
    struct Step {
        int rate = 0;
        std::int64_t min = 0;
        std::int64_t max = 0;
    };
    static constexpr std::int64_t no_end = std::int64_t{1} << 40;

    /// Returns the step of the acceleration at `travelled` counts (>= 0) from the start of a move.
    constexpr Step accelerating(std::int64_t travelled) const { return find(half, travelled, 0); }
    /// Returns the step of the deceleration at `to_go` counts (> 0) from the target.
    constexpr Step decelerating(std::int64_t to_go) const { return find(0, to_go, 1); }
    /// Returns the first flaw and sets `interval` to its interval, 0 .. 47.
    constexpr SlopeFlaw flaw(int& interval) const {
        for (interval = 0; interval < entries; ++interval) {
            const SlopeEntry here = entry(interval);
            if (here.rate == 0) return SlopeFlaw::speed_zero;
            if (here.position > max_move_counts) return SlopeFlaw::too_far;
            if (interval % half != 0 && here.position < entry(interval - 1).position) return SlopeFlaw::descending;
        }
        return SlopeFlaw::none;
    }
    friend bool operator==(const SlopeTable&, const SlopeTable&) = default;

  private:
    /// Finds the first of the 24 entries from `first` on with distance < position + reach, whose rate holds up to
    /// position + reach - 1. If none has, returns the rate of entry 47.
    constexpr Step find(int first, std::int64_t distance, std::int64_t reach) const {
        std::int64_t min_distance = 0;
        for (int i = first; i < first + half; ++i) {
            const SlopeEntry here = entry(i);
            const std::int64_t end = here.position + reach;
            if (distance < end) return {here.rate, min_distance, end - 1};
            if (end > min_distance) min_distance = end;
        }
        return {entry(entries - 1).rate, min_distance, no_end};
    }

    std::array<std::uint8_t, size> bytes_{};
};

}  // namespace motionrack::databoard4002
