// The MCX314's registers, declared once: WR0..WR7 and RR0..RR7 on a 16-bit bus, and the bit-pattern registers that
// share WR2..WR7.
//
//   offset   00h  02h  04h  06h  08h  0Ah  0Ch  0Eh          WR1..WR3, RR1..RR3 exist per axis: they access the axis
//   write    WR0  WR1  WR2  WR3  WR4  WR5  WR6  WR7          (or axes) of the last command with an axis
//   read     RR0  RR1  RR2  RR3  RR4  RR5  RR6  RR7
#pragma once

#include <motionrack/base/registers.hpp>
#include <motionrack/cards/mcx314/map/extension.hpp>

namespace motionrack::mcx314::map {

inline constexpr FieldInfo wr0_fields[] = {
    {"CODE", 0x00FF, "command code; write it last: it is executed at once"},
    {"X", 0x0100, "the command is for axis X"},
    {"Y", 0x0200, "the command is for axis Y"},
    {"Z", 0x0400, "the command is for axis Z"},
    {"U", 0x0800, "the command is for axis U"},
    {"RESET", 0x8000, "software reset of the whole chip"},
};
inline constexpr FieldInfo wr1_fields[] = {
    {"IN0L", 0x0001, "stop input IN0 acts at: 0 Low, 1 High"},
    {"IN0E", 0x0002, "stop input IN0 enabled"},
    {"IN1L", 0x0004, "stop input IN1 acts at: 0 Low, 1 High"},
    {"IN1E", 0x0008, "stop input IN1 enabled"},
    {"IN2L", 0x0010, "stop input IN2 acts at: 0 Low, 1 High"},
    {"IN2E", 0x0020, "stop input IN2 enabled"},
    {"IN3L", 0x0040, "stop input IN3 acts at: 0 Low, 1 High"},
    {"IN3E", 0x0080, "stop input IN3 enabled"},
    {"PULSE", 0x0100, "interrupt at each drive pulse"},
    {"PGECM", 0x0200, "interrupt when the counter becomes >= COMP-"},
    {"PLCM", 0x0400, "interrupt when the counter becomes < COMP-"},
    {"PLCP", 0x0800, "interrupt when the counter becomes < COMP+"},
    {"PGECP", 0x1000, "interrupt when the counter becomes >= COMP+"},
    {"CEND", 0x2000, "interrupt at the end of the constant-speed part"},
    {"CSTA", 0x4000, "interrupt at the start of the constant-speed part"},
    {"DEND", 0x8000, "interrupt at the end of a drive"},
};
inline constexpr FieldInfo wr2_fields[] = {
    {"SLMTP", 0x0001, "COMP+ is a software limit in + direction"},
    {"SLMTM", 0x0002, "COMP- is a software limit in - direction"},
    {"LMTMD", 0x0004, "limit switches stop: 0 at once, 1 decelerating"},
    {"HLMTP", 0x0008, "nLMTP acts at: 0 Low, 1 High"},
    {"HLMTM", 0x0010, "nLMTM acts at: 0 Low, 1 High"},
    {"CMPSL", 0x0020, "COMP+ and COMP- are compared with: 0 LP, 1 EP"},
    {"PLSMD", 0x0040, "pulse output: 0 two pulse trains, 1 pulse and direction"},
    {"PLSL", 0x0080, "polarity of pulses: 0 positive, 1 negative"},
    {"DIRL", 0x0100, "direction output: 0 + is Low, 1 + is High"},
    {"PINMD", 0x0200, "encoder input: 0 A/B quadrature, 1 up and down pulses"},
    {"PIND", 0x0C00, "A/B edges counted: 0 all, 1 every second, 2 every fourth"},
    {"ALML", 0x1000, "nALARM acts at: 0 Low, 1 High"},
    {"ALME", 0x2000, "nALARM enabled"},
    {"INPL", 0x4000, "nINPOS acts at: 0 Low, 1 High"},
    {"INPE", 0x8000, "nINPOS enabled: a drive ends when it is active"},
};
inline constexpr FieldInfo wr3_fields[] = {
    {"MANLD", 0x0001, "deceleration of a fixed drive: 0 automatic, 1 from DP on"},
    {"DSNDE", 0x0002, "deceleration uses D instead of A"},
    {"SACC", 0x0004, "0 T-curve, 1 S-curve"},
    {"EXOP", 0x0018, "drive by nEXPP, nEXPM: 0 off, 1 continuous, 2 fixed, 3 hand wheel (MCX314As)"},
    {"OUTSL", 0x0080, "nOUT4..7 show: 0 OUT4..7, 1 drive status"},
    {"OUT4", 0x0100, "level of nOUT4"},
    {"OUT5", 0x0200, "level of nOUT5"},
    {"OUT6", 0x0400, "level of nOUT6"},
    {"OUT7", 0x0800, "level of nOUT7"},
};
inline constexpr FieldInfo wr4_fields[] = {
    {"XOUT", 0x000F, "levels of XOUT0..3"},
    {"YOUT", 0x00F0, "levels of YOUT0..3"},
    {"ZOUT", 0x0F00, "levels of ZOUT0..3"},
    {"UOUT", 0xF000, "levels of UOUT0..3"},
};
inline constexpr FieldInfo wr5_fields[] = {
    {"AX1", 0x0003, "first axis of interpolation: its generator sets the speed"},
    {"AX2", 0x000C, "second axis"},
    {"AX3", 0x0030, "third axis"},
    {"LSPD", 0x0300, "constant vector speed: 0 off, 1 two axes, 3 three axes"},
    {"EXPLS", 0x0800, "a basic pulse at each falling edge of EXPLSN"},
    {"CMPLS", 0x1000, "a basic pulse per command 3Ah"},
    {"CIINT", 0x4000, "interrupt when the next segment may be written"},
    {"BPINT", 0x8000, "interrupt when BPSC goes from 2 to 1"},
};
inline constexpr FieldInfo rr0_fields[] = {
    {"DRV", 0x000F, "X, Y, Z, U drive"},
    {"ERR", 0x00F0, "X, Y, Z, U have an error bit in RR1 or RR2"},
    {"IDRV", 0x0100, "an interpolation runs"},
    {"CNEXT", 0x0200, "the next segment may be written"},
    {"ZONE", 0x1C00, "octant of a circular interpolation, 0..7"},
    {"BPSC", 0x6000, "bit-pattern stack counter: stacked words, 0..3"},
};
inline constexpr FieldInfo rr1_fields[] = {
    {"CMPP", 0x0001, "LP or EP >= COMP+"},
    {"CMPM", 0x0002, "LP or EP < COMP-"},
    {"ASND", 0x0004, "accelerates"},
    {"CNST", 0x0008, "constant speed"},
    {"DSND", 0x0010, "decelerates"},
    {"AASND", 0x0020, "S-curve: the rate grows"},
    {"ACNST", 0x0040, "S-curve: the rate is constant"},
    {"ADSND", 0x0080, "S-curve: the rate falls"},
    {"IN0", 0x0100, "stopped by IN0"},
    {"IN1", 0x0200, "stopped by IN1"},
    {"IN2", 0x0400, "stopped by IN2"},
    {"IN3", 0x0800, "stopped by IN3"},
    {"LMTP", 0x1000, "stopped by nLMTP"},
    {"LMTM", 0x2000, "stopped by nLMTM"},
    {"ALARM", 0x4000, "stopped by nALARM"},
    {"EMG", 0x8000, "stopped by EMGN"},
};
inline constexpr FieldInfo rr2_fields[] = {
    {"SLMTP", 0x0001, "beyond the + software limit"},
    {"SLMTM", 0x0002, "beyond the - software limit"},
    {"HLMTP", 0x0004, "nLMTP is active"},
    {"HLMTM", 0x0008, "nLMTM is active"},
    {"ALARM", 0x0010, "nALARM is enabled and active"},
    {"EMG", 0x0020, "EMGN is Low"},
    {"HOME", 0x0080, "automatic home search: Z was active already (MCX314As)"},
    {"HMST", 0x1F00, "automatic home search: state (MCX314As)"},
};
inline constexpr FieldInfo rr3_fields[] = {
    {"PULSE", 0x0001, "a drive pulse came"},
    {"PGECM", 0x0002, "the counter became >= COMP-"},
    {"PLCM", 0x0004, "the counter became < COMP-"},
    {"PLCP", 0x0008, "the counter became < COMP+"},
    {"PGECP", 0x0010, "the counter became >= COMP+"},
    {"CEND", 0x0020, "the constant-speed part ended"},
    {"CSTA", 0x0040, "the constant-speed part began"},
    {"DEND", 0x0080, "a drive ended"},
    {"HMEND", 0x0100, "the home search ended (MCX314As)"},
    {"SYNC", 0x0200, "a synchronous action ran (MCX314As)"},
};
inline constexpr FieldInfo rr4_fields[] = {
    {"XIN", 0x000F, "levels of XIN0..3"}, {"XEXPP", 0x0010, "level of XEXPP"}, {"XEXPM", 0x0020, "level of XEXPM"},
    {"XINP", 0x0040, "level of XINPOS"},  {"XALM", 0x0080, "level of XALARM"}, {"YIN", 0x0F00, "levels of YIN0..3"},
    {"YEXPP", 0x1000, "level of YEXPP"},  {"YEXPM", 0x2000, "level of YEXPM"}, {"YINP", 0x4000, "level of YINPOS"},
    {"YALM", 0x8000, "level of YALARM"},
};
inline constexpr FieldInfo rr5_fields[] = {
    {"ZIN", 0x000F, "levels of ZIN0..3"}, {"ZEXPP", 0x0010, "level of ZEXPP"}, {"ZEXPM", 0x0020, "level of ZEXPM"},
    {"ZINP", 0x0040, "level of ZINPOS"},  {"ZALM", 0x0080, "level of ZALARM"}, {"UIN", 0x0F00, "levels of UIN0..3"},
    {"UEXPP", 0x1000, "level of UEXPP"},  {"UEXPM", 0x2000, "level of UEXPM"}, {"UINP", 0x4000, "level of UINPOS"},
    {"UALM", 0x8000, "level of UALARM"},
};

inline constexpr Access write = Access::write, read = Access::read;
inline constexpr std::string_view patterns = "bit pattern", extension = "data of 60h", synchronous = "data of 64h";

inline constexpr RegisterInfo registers[] = {
    {"WR0", 0x00, 16, write, false, "", "command register", wr0_fields},
    {"WR1", 0x02, 16, write, true, "", "mode 1: stop inputs and interrupts", wr1_fields},
    {"WR2", 0x04, 16, write, true, "", "mode 2: limits, pulse output, encoder, alarm, in-position", wr2_fields},
    {"WR3", 0x06, 16, write, true, "", "mode 3: deceleration, curve, external drive, outputs", wr3_fields},
    {"WR4", 0x08, 16, write, false, "", "general outputs", wr4_fields},
    {"WR5", 0x0A, 16, write, false, "", "interpolation mode", wr5_fields},
    {"WR6", 0x0C, 16, write, false, "", "low word of the data that the next data command takes", {}},
    {"WR7", 0x0E, 16, write, false, "", "high word of the data that the next data command takes", {}},
    {"RR0", 0x00, 16, read, false, "", "main status: driving axes, errors, readiness for the next segment", rr0_fields},
    {"RR1", 0x02, 16, read, true, "", "status 1: drive and its stop reason", rr1_fields},
    {"RR2", 0x04, 16, read, true, "", "status 2: errors, live", rr2_fields},
    {"RR3", 0x06, 16, Access::read_clears, true, "", "status 3: interrupts", rr3_fields},
    {"RR4", 0x08, 16, read, false, "", "input levels of X and Y", rr4_fields},
    {"RR5", 0x0A, 16, read, false, "", "input levels of Z and U", rr5_fields},
    {"RR6", 0x0C, 16, read, false, "", "low word of what a read command (10h .. 14h) fetched", {}},
    {"RR7", 0x0E, 16, read, false, "", "high word of what a read command (10h .. 14h) fetched", {}},
    {"BP1P", 0x04, 16, write, false, patterns, "pattern of AX1, + direction, while enabled by 36h", {}},
    {"BP1M", 0x06, 16, write, false, patterns, "pattern of AX1, - direction", {}},
    {"BP2P", 0x08, 16, write, false, patterns, "pattern of AX2, + direction", {}},
    {"BP2M", 0x0A, 16, write, false, patterns, "pattern of AX2, - direction", {}},
    {"BP3P", 0x0C, 16, write, false, patterns, "pattern of AX3, + direction", {}},
    {"BP3M", 0x0E, 16, write, false, patterns, "pattern of AX3, - direction", {}},
    {"EM6", 0x0C, 16, write, true, extension, "extension mode: counters, pulses, input filters (MCX314As)", em6_fields},
    {"EM7", 0x0E, 16, write, true, extension, "extension mode: home search (MCX314As)", em7_fields},
    {"SM6", 0x0C, 16, write, true, synchronous, "synchronous action: conditions (MCX314As)", sm6_fields},
    {"SM7", 0x0E, 16, write, true, synchronous, "synchronous action: actions (MCX314As)", sm7_fields},
};
static_assert(declared<registers_flaw(registers)>());

}  // namespace motionrack::mcx314::map
