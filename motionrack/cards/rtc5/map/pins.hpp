// The RTC5's lines, in the order in which the model has its wires.
#pragma once

#include <motionrack/base/card_map.hpp>

namespace motionrack::rtc5::map {

inline constexpr PinDirection in = PinDirection::input, out = PinDirection::output;
inline constexpr PinInfo pins[] = {
    {"enc0_a", in, false, "encoder 0 (X), line A"},
    {"enc0_b", in, false, "encoder 0 (X), line B"},
    {"enc1_a", in, false, "encoder 1 (Y), line A"},
    {"enc1_b", in, false, "encoder 1 (Y), line B"},
    {"start", in, false, "external start, at the rising edge"},
    {"stop", in, false, "external stop, at the rising edge"},
    {"mcbsp_word", in, false, "the 32-bit word of the last complete transfer, as a number"},
    {"mcbsp_frame", in, false, "changes when a word is complete"},
    {"laser", out, false, "LASERON: the gate"},
    {"x", out, false, "scan head A, X, -524288 to 524287 bits, as a number"},
    {"y", out, false, "scan head A, Y"},
    {"busy", out, false, "a list is running"},
    {"io", out, false, "the 16 digital outputs, as a number"},
};
static_assert(declared<pins_flaw(pins)>());

}  // namespace motionrack::rtc5::map
