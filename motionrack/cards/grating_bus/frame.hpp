// The frame: the scale positions of one instant, as all cards of a grating bus hold them, and its reading time.
//
//   0          4        12   14          15        19
//   +----------+--------+----+-----------+---------+---- - -+----------+
//   | sequence | time   | N  | address 0 | count 0 |        | CRC-32   |   low byte first
//   +----------+--------+----+-----------+---------+---- - -+----------+   the CRC covers all bytes before it
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <optional>
#include <span>

namespace motionrack::grating_bus {

inline constexpr int max_scales = 128;  ///< scales of a bus: the seven lines of addr select 0 .. 127

/// Positions of one instant. Trivially copyable; counts and addresses beyond `words` are undefined.
struct Frame {
    std::int64_t time = 0;       ///< instant of HOLD, ticks of 0.1 ns since the start of the card
    std::uint32_t sequence = 0;  ///< counts the periods of the bus, wraps around
    std::uint32_t crc = 0;       ///< as computed by the card
    std::uint32_t words = 0;     ///< N, 1 .. 128
    std::uint32_t reserved = 0;  ///< always 0; avoids padding
    std::array<std::uint32_t, max_scales> counts{};
    std::array<std::uint8_t, max_scales> addresses{};  ///< address of the scale of each word, 0 .. 127

    Instant instant() const { return Instant{time}; }
    std::span<const std::uint32_t> positions() const { return {counts.data(), words}; }
};

/// Computes the CRC-32 of the content of a frame.
std::uint32_t crc_of(const Frame& frame);
/// Returns true if the CRC matches the content, the frame has 1 to 128 words, and each address is 0 to 127.
bool sound(const Frame& frame);
/// Returns true if two frames have equal contents, including sequence and time.
bool same(const Frame& a, const Frame& b);
/// Returns the count of the scale with this address; empty if the frame does not contain it.
std::optional<std::uint32_t> word_of(const Frame& frame, std::uint64_t address);

/// Extends `now` to 64 bits: the count nearest to `before` that has these low 32 bits. Correct while a scale moves less
/// than 2^31 counts between two frames.
constexpr std::int64_t unwrapped(std::int64_t before, std::uint32_t now) {
    return before + static_cast<std::int32_t>(now - static_cast<std::uint32_t>(before));
}

/// Wait times of the host's sequence, and the clock period of its logic.
struct BusTiming {
    Duration t1 = nanoseconds(20);  ///< T1: the decoder latches (S1), pause between words (S7)
    Duration t2 = nanoseconds(30);  ///< T2: wait from the address to stable data (S2, S8)
    Duration t3 = nanoseconds(30);  ///< T3: wait while the card stores the data (S3, S9)
    Duration clock = nanoseconds(10);

    /// Returns the time from the sample of one word to that of the next.
    constexpr Duration word_time() const { return t1 + t2 + t3 + 3 * clock; }
    /// Returns the duration of a frame of `words` words (1 .. 128, one a scale), from entering S1 to re-entering S0.
    constexpr Duration frame_time(int words) const { return words * (t1 + t2 + t3) + (3 * words + 1) * clock; }
    /// Returns the time from entering S1 to the sample of word `k`.
    constexpr Duration sample_at(int k) const { return k * word_time() + t1 + t2; }
    friend constexpr bool operator==(const BusTiming&, const BusTiming&) = default;
};

}  // namespace motionrack::grating_bus
