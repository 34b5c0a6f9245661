// What is set on the card by straps, by its trimming and by the version of its program.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/cards/databoard4002/arithmetic.hpp>
#include <motionrack/sim/blocks/quadrature_counter.hpp>

namespace motionrack::databoard4002 {

/// How O1 and O2 are counted.
enum class Counting : std::int32_t {
    up_down,    ///< method 1, straps J and K: O1 down pulses, O2 up pulses
    quadrature  ///< method 2, straps A to H
};

struct Settings {
    std::int32_t pass_ticks = 1;               ///< one pass of the firmware, in ticks of 2.5 us, 1 .. 4,000
    Duration byte_time = microseconds(100);    ///< the firmware's time for an access, 2.5 us .. 100 ms
    std::uint8_t version = 0x20;               ///< what V answers
    bool zeroing = true;                       ///< enabling the zero or reference event arms the counter's zeroing
    bool quit_zeroes = true;                   ///< Q zeroes what P and N have set
    Counting counting = Counting::quadrature;  ///< strap field
    sim::Edges folding = sim::Edges::all;      ///< method 2: 4, 2 or 1 counts for a period of the encoder
    std::int32_t first_pair = 0;  ///< method 2: the strap pair 0 A-B, 1 C-D, 2 E-F, 3 G-H; with folding 2: 0 or 1
    bool single_ended = false;    ///< limit 50 kHz a line instead of 100 kHz
    Trim trim = default_trim;     ///< of the frequency/voltage converter
};

/// Errors: refused, with the setting, its value and its range.
Result<void> check(const Settings& settings);

}  // namespace motionrack::databoard4002
