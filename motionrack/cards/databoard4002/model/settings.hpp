// Settings of the card by straps, by its trimming and by its firmware version.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/databoard4002/arithmetic.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>

namespace motionrack::databoard4002 {

/// Counting method of O1 and O2.
enum class Counting : std::int32_t {
    up_down,    ///< method 1, straps J and K: O1 down pulses, O2 up pulses
    quadrature  ///< method 2, straps A to H
};

struct Settings {
    std::int32_t firmware_pass_ticks = 1;      ///< one pass of the firmware, in ticks of 2.5 us, 1 .. 4,000
    Duration byte_time = microseconds(100);    ///< firmware time for an access, 2.5 us .. 100 ms
    std::uint8_t version = 0x20;               ///< answer to V
    bool zeroing = true;                       ///< enabling the zero or reference event arms the counter's zeroing
    bool quit_zeroes = true;                   ///< Q zeroes the values set by P and N
    Counting counting = Counting::quadrature;  ///< counting method that the straps select
    sim::Edges folding = sim::Edges::all;      ///< method 2: 4, 2 or 1 counts per encoder period
    std::int32_t first_pair = 0;  ///< method 2: the strap pair 0 A-B, 1 C-D, 2 E-F, 3 G-H; with folding 2: 0 or 1
    bool single_ended = false;    ///< O1 and O2 are single-ended: at most 50 kHz per line instead of 100 kHz
    Trim trim = default_trim;     ///< trim of the frequency/voltage converter
};

/// Checks all settings. Errors: refused, with the setting, its value and its range.
Result<void> check(const Settings& settings);

}  // namespace motionrack::databoard4002
