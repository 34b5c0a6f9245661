// The IO8255's registers, declared once: four ports of 8 bits.
//
//   offset   0       1       2       3
//   write    OUT_A   OUT_B   OUT_C   MODE_SET (D7 = 1) or BIT (D7 = 0)
//   read     PORT_A  PORT_B  PORT_C  -
#pragma once

#include <motionrack/base/registers.hpp>

namespace motionrack::io8255::map {

inline constexpr FieldInfo port_c_fields[] = {
    {"UPPER", 0x00F0, "lines 4 to 7; of group A in mode 1 D5: IBF, D4: INTE (input), D7: OBF, D6: INTE (output)"},
    {"LOWER", 0x000F,
     "lines 0 to 3; D3: INTR of group A in mode 1; D2: INTE, D1: IBF or OBF, D0: INTR of group B in mode 1"},
};
inline constexpr FieldInfo mode_fields[] = {
    {"SET", 0x0080, "1"},
    {"A_MODE", 0x0060, "group A: 0 levels, 1 strobed; 2 and 3 (both directions) are refused"},
    {"A_INPUT", 0x0010, "port A: 1 input, 0 output"},
    {"C_UPPER_INPUT", 0x0008, "lines of C 4 to 7 that no handshake uses: 1 inputs, 0 outputs"},
    {"B_MODE", 0x0004, "group B: 0 levels, 1 strobed"},
    {"B_INPUT", 0x0002, "port B: 1 input, 0 output"},
    {"C_LOWER_INPUT", 0x0001, "lines of C 0 to 3 that no handshake uses: 1 inputs, 0 outputs"},
};
inline constexpr FieldInfo bit_fields[] = {
    {"NUMBER", 0x000E, "line of port C; that of STB or ACK stands for INTE of its group"},
    {"LEVEL", 0x0001, "its new level"},
};

inline constexpr Access r = Access::read, w = Access::write;

// clang-format off
inline constexpr RegisterInfo registers[] = {
    {"PORT_A", 0, 8, r, false, "", "port A: levels of its lines, the strobed byte, or the latch of an output", {}},
    {"PORT_B", 1, 8, r, false, "", "port B: the same", {}},
    {"PORT_C", 2, 8, r, false, "", "port C: levels of inputs, latches of outputs, status of handshakes", port_c_fields},
    {"OUT_A", 0, 8, w, false, "", "latch of port A; of a strobed output also the next byte", {}},
    {"OUT_B", 1, 8, w, false, "", "latch of port B; the same", {}},
    {"OUT_C", 2, 8, w, false, "", "latch of port C: outputs of a half whose group is in mode 0", {}},
    {"MODE_SET", 3, 8, w, false, "D7 = 1", "modes and directions; all outputs go low, handshakes begin again",
     mode_fields},
    {"BIT", 3, 8, w, false, "D7 = 0", "one line of port C, or an interrupt enable", bit_fields},
};
// clang-format on
static_assert(declared<registers_flaw(registers)>());

}  // namespace motionrack::io8255::map
