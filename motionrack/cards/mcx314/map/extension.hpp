// Declarations of the MCX314As only: the words of commands 60h (extension mode) and 64h (synchronous action mode),
// input filters, widths of the deviation counter clear pulse, steps and states of the automatic home search.
//
//   WR7:WR6 ──60h──► EM7:EM6     WR7:WR6 ──64h──► SM7:SM6     (of the axes in WR0)
#pragma once

#include <array>
#include <motionrack/base/registers.hpp>
#include <motionrack/base/states.hpp>

namespace motionrack::mcx314::map {

inline constexpr FieldInfo em6_fields[] = {
    {"EPCLR", 0x0001, "EP is cleared when IN2 becomes active"},
    {"EPINV", 0x0002, "EP counts in reverse"},
    {"POINV", 0x0004, "the wires nPP and nPM are exchanged"},
    {"AVTRI", 0x0008, "fixed T-curve drives: no triangle, half the pulses at constant speed"},
    {"VRING", 0x0010, "LP and EP count in a ring: .., COMP+, 0, 1, .."},
    {"HMINT", 0x0020, "interrupt at the end of a home search"},
    {"SMODE", 0x0080, "S-curve prefers to reach V (without effect: it always does)"},
    {"FE0", 0x0100, "filter of nLMTP, nLMTM, nIN0, nIN1; for X also of EMGN"},
    {"FE1", 0x0200, "filter of nIN2"},
    {"FE2", 0x0400, "filter of nALARM, nINPOS"},
    {"FE3", 0x0800, "filter of nEXPP, nEXPM; for X also of EXPLSN"},
    {"FE4", 0x1000, "filter of nIN3"},
    {"FL", 0xE000, "delay of the filters: 2 us, 256 us, 512 us, 1.024, 2.048, 4.096, 8.192, 16.384 ms"},
};
inline constexpr FieldInfo em7_fields[] = {
    {"ST1E", 0x0001, "home search, step 1: fast to IN0"},
    {"ST1D", 0x0002, "step 1 goes: 0 +, 1 -"},
    {"ST2E", 0x0004, "step 2: slowly to IN1"},
    {"ST2D", 0x0008, "step 2 goes: 0 +, 1 -"},
    {"ST3E", 0x0010, "step 3: slowly to IN2"},
    {"ST3D", 0x0020, "step 3 goes: 0 +, 1 -"},
    {"ST4E", 0x0040, "step 4: P pulses of offset"},
    {"ST4D", 0x0080, "step 4 goes: 0 +, 1 -"},
    {"PCLR", 0x0100, "LP and EP are cleared at the end"},
    {"SAND", 0x0200, "step 3 stops where IN1 and IN2 are active"},
    {"LIMIT", 0x0400, "steps 1 and 2 look for the limit switch of their direction"},
    {"DCCE", 0x0800, "nDRIVE gives the deviation counter clear pulse instead of the drive status"},
    {"DCCL", 0x1000, "polarity of that pulse: 0 High, 1 Low"},
    {"DCCW", 0xE000, "width of that pulse: 10, 20, 100, 200 us, 1, 2, 10, 20 ms"},
};
inline constexpr FieldInfo sm6_fields[] = {
    {"PGECP", 0x0001, "condition: the counter becomes >= COMP+"},
    {"PLCP", 0x0002, "condition: the counter becomes < COMP+"},
    {"PLCM", 0x0004, "condition: the counter becomes < COMP-"},
    {"PGECM", 0x0008, "condition: the counter becomes >= COMP-"},
    {"DSTA", 0x0010, "condition: a drive starts"},
    {"DEND", 0x0020, "condition: a drive ends"},
    {"IN3UP", 0x0040, "condition: IN3 rises"},
    {"IN3DN", 0x0080, "condition: IN3 falls"},
    {"LPRD", 0x0100, "condition: LP is read (command 10h)"},
    {"CMD", 0x0200, "condition: command 65h"},
    {"AXIS", 0xE000, "the other axes that act too, in the order X Y Z U without this one, the first at D13"},
};
inline constexpr FieldInfo sm7_fields[] = {
    {"FDRVP", 0x0001, "action: drive P pulses in + direction (20h)"},
    {"FDRVM", 0x0002, "action: drive P pulses in - direction (21h)"},
    {"CDRVP", 0x0004, "action: continuous drive in + direction (22h)"},
    {"CDRVM", 0x0008, "action: continuous drive in - direction (23h)"},
    {"SSTOP", 0x0010, "action: decelerating stop (26h)"},
    {"ISTOP", 0x0020, "action: immediate stop (27h)"},
    {"LPSAV", 0x0040, "action: LP to BR"},
    {"EPSAV", 0x0080, "action: EP to BR"},
    {"LPSET", 0x0100, "action: WR7:WR6 to LP"},
    {"EPSET", 0x0200, "action: WR7:WR6 to EP"},
    {"OPSET", 0x0400, "action: WR7:WR6 to P"},
    {"VLSET", 0x0800, "action: WR6 to V"},
    {"OUT", 0x4000, "action: the pulse of command 63h"},
    {"INT", 0x8000, "action: interrupt, RR3 SYNC"},
};

/// Delays of the input filters by FL, in ticks of 125 ns. Input pulses up to 7/8 of the delay are always suppressed.
inline constexpr std::array<std::int32_t, 8> filter_ticks = {16, 2'048, 4'096, 8'192, 16'384, 32'768, 65'536, 131'072};

/// Widths of the deviation counter clear pulse by DCCW, in ticks of 125 ns.
inline constexpr std::array<std::int32_t, 8> clear_ticks = {80, 160, 800, 1'600, 8'000, 16'000, 80'000, 160'000};

/// A state of the home search in which the axis drives.
struct HomeDrive {
    int hmst;   ///< value of RR2 HMST
    int step;   ///< step, 1 .. 4, whose enable and direction bits apply
    bool back;  ///< drives against its step's direction
    bool slow;  ///< at HV instead of V
};
inline constexpr HomeDrive home_drives[] = {
    {3, 1, false, false}, {8, 2, false, true},  {12, 2, true, true},
    {15, 2, false, true}, {20, 3, false, true}, {25, 4, false, false},
};
constexpr const HomeDrive& home_drive(int hmst) {
    for (const HomeDrive& each : home_drives)
        if (each.hmst == hmst) return each;
    return home_drives[0];
}

// ---- state machines

inline constexpr StateInfo home_states[] = {
    {"idle", "HMST 0: no home search"},
    {"near", "HMST 3: step 1, fast, until IN0 is active"},
    {"home", "HMST 8: step 2, slowly, until IN1 is active"},
    {"escape", "HMST 12: step 2, slowly back, until IN1 is inactive"},
    {"again", "HMST 15: step 2, slowly, until IN1 is active again"},
    {"index", "HMST 20: step 3, slowly, until IN2 (and with SAND IN1) is active"},
    {"offset", "HMST 25: step 4, P pulses"},
};
inline constexpr TransitionInfo home_transitions[] = {
    {"idle", "near", "62h; ST1E, IN0 not active"},
    {"idle", "home", "62h; step 1 not enabled or IN0 active, ST2E, IN1 not active"},
    {"idle", "escape", "62h; as before, but IN1 or the limit in the step's direction is active"},
    {"idle", "index", "62h; steps 1 and 2 not to be done, ST3E"},
    {"idle", "offset", "62h; only ST4E"},
    {"near", "home", "stopped at IN0; ST2E, IN1 not active"},
    {"near", "escape", "stopped at IN0; ST2E, IN1 or the limit in the step's direction is active"},
    {"near", "index", "stopped at IN0; ST3E without ST2E"},
    {"near", "offset", "stopped at IN0; ST4E alone is left"},
    {"home", "escape", "stopped by the limit in the step's direction"},
    {"home", "index", "stopped at IN1; ST3E"},
    {"home", "offset", "stopped at IN1; ST4E without ST3E"},
    {"escape", "again", "IN1 was active and is inactive"},
    {"again", "index", "stopped at IN1; ST3E"},
    {"again", "offset", "stopped at IN1; ST4E without ST3E"},
    {"index", "offset", "stopped at IN2, and the deviation counter clear pulse is over; ST4E"},
    {"near", "idle", "no step is left; or stopped by another event"},
    {"home", "idle", "no step is left; or stopped by another event"},
    {"escape", "idle", "stopped by an event other than IN1"},
    {"again", "idle", "no step is left; or stopped by another event"},
    {"index", "idle", "no step is left; or stopped by another event"},
    {"offset", "idle", "P pulses are out; or stopped"},
};
inline constexpr StateInfo filter_states[] = {
    {"same", "the filtered level equals the input"},
    {"differs", "the input differs, but not yet for the delay"},
};
inline constexpr TransitionInfo filter_transitions[] = {
    {"same", "differs", "the input changes"},
    {"differs", "same", "the input changes back within the delay"},
    {"differs", "same", "the delay is over: the filtered level changes"},
};
inline constexpr StateInfo clear_states[] = {
    {"rest", "no pulse"},
    {"pulse", "nDRIVE is at DCCL's level"},
};
inline constexpr TransitionInfo clear_transitions[] = {
    {"rest", "pulse", "63h, the end of step 3 of a home search, or the action OUT, with DCCE"},
    {"pulse", "pulse", "63h, the end of step 3 or OUT during the pulse, with DCCE: the pulse restarts"},
    {"pulse", "rest", "the pulse width has elapsed"},
};
inline constexpr StateInfo action_states[] = {
    {"waiting", "no condition of SM is met"},
    {"due", "a condition is met: the axis and those of AXIS act at the end of this tick or write"},
};
inline constexpr TransitionInfo action_transitions[] = {
    {"waiting", "due", "a condition in SM is met"},
    {"due", "waiting", "the axes have executed the actions of their SM7"},
};

}  // namespace motionrack::mcx314::map
