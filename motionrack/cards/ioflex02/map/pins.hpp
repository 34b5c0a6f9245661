// The IOFLEX02's pins, in the order of the model's wires.
//
// The card has 16 inputs, and the project "position" uses all of them: A, B, Z and Cal of four axes. in0 to in15 are
// the same wires by their bit of IN, as in ReadInL and ReadInH.
//
//   bit of IN   15  14  13  12   11  10   9   8    7   6   5   4    3   2   1   0
//               Cal4 Z   B   A   Cal3 Z   B   A   Cal2 Z   B   A   Cal1 Z   B   A
//               encoder 3        encoder 2        encoder 1        encoder 0
#pragma once

#include <motionrack/base/card_map.hpp>

namespace motionrack::ioflex02::map {

inline constexpr PinDirection in = PinDirection::input, out = PinDirection::output;
inline constexpr PinInfo pins[] = {
    {"a0", in, false, "encoder 0, line A"},
    {"a1", in, false, "encoder 1, line A"},
    {"a2", in, false, "encoder 2, line A"},
    {"a3", in, false, "encoder 3, line A"},
    {"b0", in, false, "encoder 0, line B"},
    {"b1", in, false, "encoder 1, line B"},
    {"b2", in, false, "encoder 2, line B"},
    {"b3", in, false, "encoder 3, line B"},
    {"z0", in, false, "encoder 0, index"},
    {"z1", in, false, "encoder 1, index"},
    {"z2", in, false, "encoder 2, index"},
    {"z3", in, false, "encoder 3, index"},
    {"cal0", in, false, "calibration input Cal1"},
    {"cal1", in, false, "calibration input Cal2"},
    {"cal2", in, false, "calibration input Cal3"},
    {"cal3", in, false, "calibration input Cal4"},
    {"in0", in, false, "input 0: line A of encoder 0", "a0"},
    {"in1", in, false, "input 1: line B of encoder 0", "b0"},
    {"in2", in, false, "input 2: index of encoder 0", "z0"},
    {"in3", in, false, "input 3: calibration input Cal1", "cal0"},
    {"in4", in, false, "input 4: line A of encoder 1", "a1"},
    {"in5", in, false, "input 5: line B of encoder 1", "b1"},
    {"in6", in, false, "input 6: index of encoder 1", "z1"},
    {"in7", in, false, "input 7: calibration input Cal2", "cal1"},
    {"in8", in, false, "input 8: line A of encoder 2", "a2"},
    {"in9", in, false, "input 9: line B of encoder 2", "b2"},
    {"in10", in, false, "input 10: index of encoder 2", "z2"},
    {"in11", in, false, "input 11: calibration input Cal3", "cal2"},
    {"in12", in, false, "input 12: line A of encoder 3", "a3"},
    {"in13", in, false, "input 13: line B of encoder 3", "b3"},
    {"in14", in, false, "input 14: index of encoder 3", "z3"},
    {"in15", in, false, "input 15: calibration input Cal4", "cal3"},
    {"out0", out, false, "output 0 (X5)"},
    {"out1", out, false, "output 1 (X5)"},
    {"out2", out, false, "output 2 (X5)"},
    {"out3", out, false, "output 3 (X5)"},
    {"out4", out, false, "output 4 (X5)"},
    {"out5", out, false, "output 5 (X5)"},
    {"out6", out, false, "output 6 (X5)"},
    {"out7", out, false, "output 7 (X5)"},
    {"out8", out, false, "output 8 (X5)"},
    {"out9", out, false, "output 9 (X5)"},
    {"out10", out, false, "output 10 (X5)"},
    {"out11", out, false, "output 11 (X5)"},
    {"out12", out, false, "output 12 (X5)"},
    {"out13", out, false, "output 13 (X5)"},
    {"out14", out, false, "output 14 (X5)"},
    {"out15", out, false, "output 15 (X5)"},
    {"out16", out, false, "output 16 (X7, not driven by this project)"},
    {"out17", out, false, "output 17 (X7, not driven by this project)"},
    {"out18", out, false, "output 18 (X7, not driven by this project)"},
    {"out19", out, false, "output 19 (X7, not driven by this project)"},
    {"out20", out, false, "output 20 (X7, not driven by this project)"},
    {"out21", out, false, "output 21 (X7, not driven by this project)"},
    {"out22", out, false, "output 22 (X7, not driven by this project)"},
    {"out23", out, false, "output 23 (X7, not driven by this project)"},
    {"out24", out, false, "output 24 (X7, not driven by this project)"},
    {"out25", out, false, "output 25 (X7, not driven by this project)"},
    {"out26", out, false, "output 26 (X7, not driven by this project)"},
    {"out27", out, false, "output 27 (X7, not driven by this project)"},
    {"out28", out, false, "output 28 (X7, not driven by this project)"},
    {"out29", out, false, "output 29 (X7, not driven by this project)"},
    {"out30", out, false, "output 30 (X7, not driven by this project)"},
    {"out31", out, false, "output 31 (X7, not driven by this project)"},
};
static_assert(declared<pins_flaw(pins)>());

}  // namespace motionrack::ioflex02::map
