// Declares the MCX314's commands with the documented ranges of their data.
#pragma once

#include <motionrack/base/commands.hpp>

namespace motionrack::mcx314::map {

inline constexpr std::int64_t min_32 = -2'147'483'648LL, max_32 = 2'147'483'647LL;
inline constexpr std::int64_t min_24 = -8'388'608, max_24 = 8'388'607;
inline constexpr std::int64_t max_pulses = 268'435'455;
inline constexpr std::string_view as_only = "MCX314As";

inline constexpr CommandInfo commands[] = {
    {"R", 0x00, 4, 16'000, 8'000'000, "", "",
     "range: the multiple M = 8,000,000 / R is the unit of speeds; not to be written while driving"},
    {"K", 0x01, 2, 1, 65'535, "62.5e6 / K * M pulses/s3", "", "jerk of the S-curve"},
    {"A", 0x02, 2, 1, 8'000, "125 * M pulses/s2", "", "acceleration"},
    {"D", 0x03, 2, 1, 8'000, "125 * M pulses/s2", "", "deceleration, where DSNDE is set"},
    {"SV", 0x04, 2, 1, 8'000, "M pulses/s", "", "initial speed"},
    {"V", 0x05, 2, 1, 8'000, "M pulses/s", "", "drive speed; also while driving"},
    {"P", 0x06, 4, min_24, max_pulses, "pulses", "",
     "output pulses of a fixed drive, 0 .. 268,435,455 (MCX314As: 4,294,967,295), or finish point of an interpolation, "
     "-8,388,608 .. 8,388,607 (MCX314As: -2,147,483,646 .. 2,147,483,646)"},
    {"DP", 0x07, 4, 0, max_pulses, "pulses", "",
     "manual deceleration point: pulses made when the deceleration begins; MCX314As: 0 .. 4,294,967,295"},
    {"C", 0x08, 4, min_24, max_24, "pulses", "",
     "centre of an arc, relative to its start; MCX314As: -2,147,483,646 .. 2,147,483,646"},
    {"LP", 0x09, 4, min_32, max_32, "pulses", "", "logical position counter"},
    {"EP", 0x0A, 4, min_32, max_32, "counts", "", "real position counter (encoder)"},
    {"COMP_PLUS", 0x0B, 4, min_32, max_32, "", "", "comparison register COMP+"},
    {"COMP_MINUS", 0x0C, 4, min_32, max_32, "", "", "comparison register COMP-"},
    {"AO", 0x0D, 2, 0, 65'535, "pulses", "", "acceleration counter offset: pulses reserved for the end at SV"},
    {"L", 0x0E, 2, 1, 65'535, "62.5e6 / L * M pulses/s3", as_only, "jerk of falling S-ramps, where DSNDE is set"},
    {"NOP", 0x0F, 0, 0, 0, "", "", "chooses the axis of WR1..WR3, RR1..RR3"},
    {"READ_LP", 0x10, 4, min_32, max_32, "pulses", "", "LP to RR6, RR7"},
    {"READ_EP", 0x11, 4, min_32, max_32, "counts", "", "EP to RR6, RR7"},
    {"READ_CV", 0x12, 2, 0, 8'000, "M pulses/s", "", "present speed to RR6; 0 at standstill"},
    {"READ_CA", 0x13, 2, 0, 8'000, "125 * M pulses/s2", "",
     "present acceleration or deceleration to RR6; at constant speed the last one"},
    {"READ_BR", 0x14, 4, min_32, max_32, "", as_only, "reads the position saved by a synchronous action to RR6, RR7"},
    {"FIXED_PLUS", 0x20, 0, 0, 0, "", "", "drives P pulses in + direction"},
    {"FIXED_MINUS", 0x21, 0, 0, 0, "", "", "drives P pulses in - direction"},
    {"CONTINUOUS_PLUS", 0x22, 0, 0, 0, "", "", "drives in + direction until stopped"},
    {"CONTINUOUS_MINUS", 0x23, 0, 0, 0, "", "", "drives in - direction until stopped"},
    {"HOLD", 0x24, 0, 0, 0, "", "", "drive commands wait for START"},
    {"START", 0x25, 0, 0, 0, "", "", "held drives start together; clears the finishing status"},
    {"SLOW_STOP", 0x26, 0, 0, 0, "", "", "decelerating stop"},
    {"QUICK_STOP", 0x27, 0, 0, 0, "", "", "stop at once"},
    {"LINE2", 0x30, 0, 0, 0, "", "", "linear interpolation of two axes"},
    {"LINE3", 0x31, 0, 0, 0, "", "", "linear interpolation of three axes"},
    {"ARC_CW", 0x32, 0, 0, 0, "", "", "circular interpolation, clockwise"},
    {"ARC_CCW", 0x33, 0, 0, 0, "", "", "circular interpolation, counter-clockwise"},
    {"BP2", 0x34, 0, 0, 0, "", "", "bit-pattern interpolation of two axes"},
    {"BP3", 0x35, 0, 0, 0, "", "", "bit-pattern interpolation of three axes"},
    {"BP_ENABLE", 0x36, 0, 0, 0, "", "", "WR2..WR7 become the pattern registers"},
    {"BP_DISABLE", 0x37, 0, 0, 0, "", "", "WR2..WR7 are themselves again"},
    {"BP_STACK", 0x38, 0, 0, 0, "", "", "stacks the pattern registers"},
    {"BP_CLEAR", 0x39, 0, 0, 0, "", "", "clears the stack"},
    {"STEP", 0x3A, 0, 0, 0, "", "", "one interpolation step"},
    {"DECELERATION_ON", 0x3B, 0, 0, 0, "", "", "interpolation decelerates at its end"},
    {"DECELERATION_OFF", 0x3C, 0, 0, 0, "", "", "interpolation keeps its speed to the end"},
    {"INTERPOLATION_INTERRUPT_CLEAR", 0x3D, 0, 0, 0, "", "", "clears the interpolation interrupt"},
    {"EM", 0x60, 4, min_32, max_32, "", as_only, "extension mode: EM7:EM6"},
    {"HV", 0x61, 2, 1, 8'000, "M pulses/s", as_only, "speed of the slow steps of the home search"},
    {"HOME", 0x62, 0, 0, 0, "", as_only, "automatic home search by EM7"},
    {"DCC", 0x63, 0, 0, 0, "", as_only, "deviation counter clear pulse on nDRIVE, where DCCE is set"},
    {"SM", 0x64, 4, min_32, max_32, "", as_only, "synchronous action mode: SM7:SM6"},
    {"SYNC", 0x65, 0, 0, 0, "", as_only, "the condition CMD of the synchronous action"},
};
static_assert(declared<commands_flaw(commands)>());

}  // namespace motionrack::mcx314::map
