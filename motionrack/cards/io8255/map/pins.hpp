// The IO8255's pins, in the order of the model's wires.
//
// A line of the chip is an input or an output, as the control word says; a wire of a rack has one direction. The card
// has a driver and a receiver on each line, each with a pin of its own:
//
//              ┌── driver ────► pa3      low while line 3 of port A is an input
//   line PA3 ──┤
//              └── receiver ◄── pa3_in   high while nothing is wired to it
#pragma once

#include <motionrack/base/card_map.hpp>

namespace motionrack::io8255::map {

inline constexpr PinDirection in = PinDirection::input, out = PinDirection::output;
inline constexpr PinInfo pins[] = {
    {"pa0", out, false, "port A, line 0, driven"},
    {"pa1", out, false, "port A, line 1, driven"},
    {"pa2", out, false, "port A, line 2, driven"},
    {"pa3", out, false, "port A, line 3, driven"},
    {"pa4", out, false, "port A, line 4, driven"},
    {"pa5", out, false, "port A, line 5, driven"},
    {"pa6", out, false, "port A, line 6, driven"},
    {"pa7", out, false, "port A, line 7, driven"},
    {"pb0", out, false, "port B, line 0, driven"},
    {"pb1", out, false, "port B, line 1, driven"},
    {"pb2", out, false, "port B, line 2, driven"},
    {"pb3", out, false, "port B, line 3, driven"},
    {"pb4", out, false, "port B, line 4, driven"},
    {"pb5", out, false, "port B, line 5, driven"},
    {"pb6", out, false, "port B, line 6, driven"},
    {"pb7", out, false, "port B, line 7, driven"},
    {"pc0", out, false, "port C, line 0, driven; INTR of group B in mode 1"},
    {"pc1", out, false, "port C, line 1, driven; IBF or OBF of group B in mode 1"},
    {"pc2", out, false, "port C, line 2, driven"},
    {"pc3", out, false, "port C, line 3, driven; INTR of group A in mode 1"},
    {"pc4", out, false, "port C, line 4, driven"},
    {"pc5", out, false, "port C, line 5, driven; IBF of group A in mode 1, input"},
    {"pc6", out, false, "port C, line 6, driven"},
    {"pc7", out, false, "port C, line 7, driven; OBF of group A in mode 1, output"},
    {"pa0_in", in, false, "port A, line 0, received"},
    {"pa1_in", in, false, "port A, line 1, received"},
    {"pa2_in", in, false, "port A, line 2, received"},
    {"pa3_in", in, false, "port A, line 3, received"},
    {"pa4_in", in, false, "port A, line 4, received"},
    {"pa5_in", in, false, "port A, line 5, received"},
    {"pa6_in", in, false, "port A, line 6, received"},
    {"pa7_in", in, false, "port A, line 7, received"},
    {"pb0_in", in, false, "port B, line 0, received"},
    {"pb1_in", in, false, "port B, line 1, received"},
    {"pb2_in", in, false, "port B, line 2, received"},
    {"pb3_in", in, false, "port B, line 3, received"},
    {"pb4_in", in, false, "port B, line 4, received"},
    {"pb5_in", in, false, "port B, line 5, received"},
    {"pb6_in", in, false, "port B, line 6, received"},
    {"pb7_in", in, false, "port B, line 7, received"},
    {"pc0_in", in, false, "port C, line 0, received"},
    {"pc1_in", in, false, "port C, line 1, received"},
    {"pc2_in", in, false, "port C, line 2, received; STB or ACK of group B in mode 1"},
    {"pc3_in", in, false, "port C, line 3, received"},
    {"pc4_in", in, false, "port C, line 4, received; STB of group A in mode 1, input"},
    {"pc5_in", in, false, "port C, line 5, received"},
    {"pc6_in", in, false, "port C, line 6, received; ACK of group A in mode 1, output"},
    {"pc7_in", in, false, "port C, line 7, received"},
    {"int", out, false, "INTR of group A or of group B"},
};
static_assert(declared<pins_flaw(pins)>());

}  // namespace motionrack::io8255::map
