// The IOFLEX02's registers, declared once. The map is the project's own, as the card's hardware manual was not
// available. Registers are 16 bits wide; offsets are byte offsets from the card's base address.
//
//   00h .. 08h  the card's fixed logic: answers with or without a loaded array
//   0Ah .. 45h  the project in the array: FFFFh while no project runs
//   50h .. 65h  the same for one axis, selected by AXIS
//
// 24-bit values are two registers: _L has bits 0 to 15, _H bits 16 to 23 (read as zeros above).
#pragma once

#include <motionrack/base/registers.hpp>

namespace motionrack::ioflex02::map {

inline constexpr FieldInfo status_fields[] = {
    {"LOADING", 0x0001, "the array waits for the image's bytes"},
    {"STARTING", 0x0002, "the image was accepted, the array configures itself"},
    {"RUNNING", 0x0004, "a project runs"},
    {"FAILED", 0x0008, "the image was refused; CFG_ERROR says why"},
    {"ILLEGAL", 0x00F0, "bit 4 + n: axis n has had illegal transitions since CLEAR_ERRORS"},
};
inline constexpr FieldInfo error_fields[] = {
    {"CODE", 0x000F,
     "0 none, 1 no image of this card, 2 length out of range, 3 cut short, 4 CRC-32 wrong, 5 unknown project"},
};
inline constexpr FieldInfo ident_fields[] = {
    {"IDENT", 0x00FF, "version of the project"},
};
inline constexpr FieldInfo sts_fields[] = {
    {"CAL0", 0x0001, "axis 0: 1 is sCal, 0 is sNotCal"},
    {"CAL1", 0x0002, "axis 1"},
    {"CAL2", 0x0004, "axis 2"},
    {"CAL3", 0x0008, "axis 3"},
};
inline constexpr FieldInfo in_fields[] = {
    {"AXIS0", 0x000F, "encoder 0: from the lowest bit A, B, Z, Cal1"},
    {"AXIS1", 0x00F0, "encoder 1: A, B, Z, Cal2"},
    {"AXIS2", 0x0F00, "encoder 2: A, B, Z, Cal3"},
    {"AXIS3", 0xF000, "encoder 3: A, B, Z, Cal4"},
};
inline constexpr FieldInfo down_fields[] = {
    {"DOWN", 0x000F, "bit n: the last count of axis n was downwards"},
};
inline constexpr FieldInfo lines_fields[] = {
    {"A", 0x0001, "level of A, behind the filter"},
    {"B", 0x0002, "level of B"},
    {"Z", 0x0004, "level of Z"},
    {"CAL", 0x0008, "level of the calibration input"},
};
inline constexpr FieldInfo control_fields[] = {
    {"CONFIGURE", 0x0001, "empties the array and waits for an image"},
    {"END", 0x0002, "the image has ended; if bytes are missing it is refused"},
    {"RESET", 0x0004, "the project restarts: positions and time 0, sCal, outputs 0, errors cleared"},
    {"CLEAR_ERRORS", 0x0008, "clears the counts of illegal transitions"},
};
inline constexpr FieldInfo strobe_fields[] = {
    {"CAPTURE", 0x0001, "latches time, positions and all captured registers at this instant"},
    {"CLEAR_TIME", 0x0002, "zeroes the time, after the capture; not its phase"},
};
inline constexpr FieldInfo cmd_fields[] = {
    {"CMD0", 0x0003, "command of axis 0: cNop, cRes, cResNm, cResNmSig"},
    {"CMD1", 0x000C, "of axis 1"},
    {"CMD2", 0x0030, "of axis 2"},
    {"CMD3", 0x00C0, "of axis 3"},
    {"KEEP", 0x0F00, "bit 8 + n: axis n ignores the command and stays armed"},
};
inline constexpr FieldInfo byte_fields[] = {
    {"BYTE", 0x00FF, "a bit an output"},
};
inline constexpr FieldInfo axis_fields[] = {
    {"NUMBER", 0x0003, "axis 0 to 3"},
};
inline constexpr FieldInfo mode_fields[] = {
    {"REVERSED", 0x0001, "counts the other way"},
    {"EDGES", 0x0006, "0: four counts a line (x4), 1: two (x2), 2 and 3: one (x1)"},
    {"INDEX_LOW", 0x0008, "the index is where Z is low: its edge is the falling one"},
    {"FILTER", 0x00F0, "a level of A, B, Z and Cal counts when it has been the same for FILTER + 1 samples"},
};

inline constexpr Access r = Access::read, w = Access::write;

// clang-format off
inline constexpr RegisterInfo registers[] = {
    // ---- the card
    {"CONTROL", 0x00, 16, w, false, "", "configuration and reset; bits act from the lowest to the highest",
     control_fields},
    {"DATA", 0x02, 16, w, false, "", "two bytes of the image, the first one low", {}},
    {"SIGNATURE", 0x00, 16, r, false, "", "4F49h: an IOFLEX02 answers here", {}},
    {"SERIAL", 0x02, 16, r, false, "", "the card's serial number", {}},
    {"SERIAL_N", 0x04, 16, r, false, "", "the same with every bit inverted; two cards at one address read otherwise",
     {}},
    {"STATUS", 0x06, 16, r, false, "", "the array's state, and which axes have errors", status_fields},
    {"CFG_ERROR", 0x08, 16, r, false, "", "why the last image was refused; cleared by CONFIGURE", error_fields},
    // ---- the project
    {"STROBE", 0x10, 16, w, false, "", "capture of one instant, reset of the time", strobe_fields},
    {"CMD", 0x12, 16, w, false, "", "calibration commands of the axes, together", cmd_fields},
    {"OUTL", 0x14, 16, w, false, "", "low 8 outputs of X5", byte_fields},
    {"OUTH", 0x16, 16, w, false, "", "high 8 outputs of X5; X7 is not driven by this project", byte_fields},
    {"AXIS", 0x18, 16, w, false, "", "chooses the axis of the registers per axis", axis_fields},
    {"IDENT", 0x0A, 16, r, false, "", "the project in the array", ident_fields},
    {"STS", 0x0C, 16, r, false, "", "calibration status", sts_fields},
    {"IN", 0x0E, 16, r, false, "", "the 16 inputs as they are, before the filter", in_fields},
    {"TIME_L", 0x10, 16, r, false, "", "captured: time in ticks of 1.2 us, low", {}},
    {"TIME_H", 0x12, 16, r, false, "", "captured: time, high; wraps after 20.13 s", {}},
    {"POS0_L", 0x14, 16, r, false, "", "captured: position of axis 0 since its calibration, low", {}},
    {"POS0_H", 0x16, 16, r, false, "", "captured: the same, high", {}},
    {"POS1_L", 0x18, 16, r, false, "", "captured: axis 1", {}},
    {"POS1_H", 0x1A, 16, r, false, "", "captured: axis 1", {}},
    {"POS2_L", 0x1C, 16, r, false, "", "captured: axis 2", {}},
    {"POS2_H", 0x1E, 16, r, false, "", "captured: axis 2", {}},
    {"POS3_L", 0x20, 16, r, false, "", "captured: axis 3", {}},
    {"POS3_H", 0x22, 16, r, false, "", "captured: axis 3", {}},
    {"RAW0_L", 0x24, 16, r, false, "", "captured: counts of axis 0 since the start, which no calibration zeroes, low",
     {}},
    {"RAW0_H", 0x26, 16, r, false, "", "captured: the same, high", {}},
    {"RAW1_L", 0x28, 16, r, false, "", "captured: axis 1", {}},
    {"RAW1_H", 0x2A, 16, r, false, "", "captured: axis 1", {}},
    {"RAW2_L", 0x2C, 16, r, false, "", "captured: axis 2", {}},
    {"RAW2_H", 0x2E, 16, r, false, "", "captured: axis 2", {}},
    {"RAW3_L", 0x30, 16, r, false, "", "captured: axis 3", {}},
    {"RAW3_H", 0x32, 16, r, false, "", "captured: axis 3", {}},
    {"AGE0_L", 0x34, 16, r, false, "",
     "captured: ticks of 1.2 us since the last count of axis 0, low; FFFFFFh: that or more, or none yet", {}},
    {"AGE0_H", 0x36, 16, r, false, "", "captured: the same, high", {}},
    {"AGE1_L", 0x38, 16, r, false, "", "captured: axis 1", {}},
    {"AGE1_H", 0x3A, 16, r, false, "", "captured: axis 1", {}},
    {"AGE2_L", 0x3C, 16, r, false, "", "captured: axis 2", {}},
    {"AGE2_H", 0x3E, 16, r, false, "", "captured: axis 2", {}},
    {"AGE3_L", 0x40, 16, r, false, "", "captured: axis 3", {}},
    {"AGE3_H", 0x42, 16, r, false, "", "captured: axis 3", {}},
    {"DOWN", 0x44, 16, r, false, "", "captured: directions", down_fields},
    // ---- one axis, selected by AXIS
    {"LINES", 0x50, 16, r, true, "", "captured: levels", lines_fields},
    {"EDGES_A", 0x52, 16, r, true, "", "captured: edges of A since the start, modulo 65,536", {}},
    {"EDGES_B", 0x54, 16, r, true, "", "captured: edges of B", {}},
    {"INDEXES", 0x56, 16, r, true, "", "captured: index pulses since the start, modulo 65,536", {}},
    {"INDEX_AT_L", 0x58, 16, r, true, "", "captured: RAW at the last index pulse, low", {}},
    {"INDEX_AT_H", 0x5A, 16, r, true, "", "captured: the same, high", {}},
    {"ILLEGAL", 0x5C, 16, r, true, "", "captured: illegal transitions since CLEAR_ERRORS, at most FFFFh", {}},
    {"ILLEGAL_AT_L", 0x5E, 16, r, true, "", "captured: RAW at the last illegal transition, low", {}},
    {"ILLEGAL_AT_H", 0x60, 16, r, true, "", "captured: the same, high", {}},
    {"MODE_NOW", 0x62, 16, r, true, "", "how the axis counts", mode_fields},
    {"MODE", 0x62, 16, w, true, "", "mode of the axis from now on; a reset restores that of the image", mode_fields},
};
// clang-format on
static_assert(declared<registers_flaw(registers)>());

}  // namespace motionrack::ioflex02::map
