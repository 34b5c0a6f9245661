// The lines of the RTC5, in the order of the model's wires.
#pragma once

#include <array>
#include <motionrack/base/card_map.hpp>

namespace motionrack::rtc5::map {

/// A line of the card; its wire carries a level (1 bit) or a whole number of `bits` bits.
struct WidePin {
    PinInfo pin;
    int bits = 1;
};

inline constexpr PinDirection in = PinDirection::input, out = PinDirection::output;
inline constexpr WidePin lines[] = {
    {{"enc0_a", in, false, "encoder 0 (X), line A"}},
    {{"enc0_b", in, false, "encoder 0 (X), line B"}},
    {{"enc1_a", in, false, "encoder 1 (Y), line A"}},
    {{"enc1_b", in, false, "encoder 1 (Y), line B"}},
    {{"start_n", in, true, "external start, at the falling edge; high when open"}},
    {{"stop_n", in, true, "external stop, at the falling edge; high when open"}},
    {{"mcbsp", in, false, "the 32-bit word of the last complete transfer, as a number; a change is a new word"}, 32},
    {{"mcbsp_frame", in, false, "toggles when a complete word equals the previous one"}},
    {{"laser_on", out, false, "LASERON: the gate"}},
    {{"xout", out, false, "scan head A, X, -524288 to 524287 bits, as a number"}, 20},
    {{"yout", out, false, "scan head A, Y"}, 20},
    {{"busy", out, false, "a list is running"}},
    {{"io", out, false, "the 16 digital outputs, as a number"}, 16},
};
inline constexpr auto pins = [] {
    std::array<PinInfo, std::size(lines)> found{};
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = lines[i].pin;
    return found;
}();
static_assert(declared<pins_flaw(pins)>());

}  // namespace motionrack::rtc5::map
