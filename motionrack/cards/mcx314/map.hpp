// The MCX314's map: declarations of its registers, commands and state machines, as tables for documents and constants
// for programs.
#pragma once

#include <motionrack/base/card_map.hpp>
#include <motionrack/cards/mcx314/map/commands.hpp>
#include <motionrack/cards/mcx314/map/registers.hpp>

namespace motionrack::mcx314 {

/// Byte offsets of the registers.
namespace reg {
inline constexpr std::uint32_t WR0 = register_named(map::registers, "WR0").offset;
inline constexpr std::uint32_t WR1 = register_named(map::registers, "WR1").offset;
inline constexpr std::uint32_t WR2 = register_named(map::registers, "WR2").offset;
inline constexpr std::uint32_t WR3 = register_named(map::registers, "WR3").offset;
inline constexpr std::uint32_t WR4 = register_named(map::registers, "WR4").offset;
inline constexpr std::uint32_t WR5 = register_named(map::registers, "WR5").offset;
inline constexpr std::uint32_t WR6 = register_named(map::registers, "WR6").offset;
inline constexpr std::uint32_t WR7 = register_named(map::registers, "WR7").offset;
inline constexpr std::uint32_t RR0 = register_named(map::registers, "RR0").offset;
inline constexpr std::uint32_t RR1 = register_named(map::registers, "RR1").offset;
inline constexpr std::uint32_t RR2 = register_named(map::registers, "RR2").offset;
inline constexpr std::uint32_t RR3 = register_named(map::registers, "RR3").offset;
inline constexpr std::uint32_t RR4 = register_named(map::registers, "RR4").offset;
inline constexpr std::uint32_t RR5 = register_named(map::registers, "RR5").offset;
inline constexpr std::uint32_t RR6 = register_named(map::registers, "RR6").offset;
inline constexpr std::uint32_t RR7 = register_named(map::registers, "RR7").offset;
}  // namespace reg

/// Command codes.
namespace cmd {
inline constexpr unsigned R = command_named(map::commands, "R").code;
inline constexpr unsigned K = command_named(map::commands, "K").code;
inline constexpr unsigned A = command_named(map::commands, "A").code;
inline constexpr unsigned D = command_named(map::commands, "D").code;
inline constexpr unsigned SV = command_named(map::commands, "SV").code;
inline constexpr unsigned V = command_named(map::commands, "V").code;
inline constexpr unsigned P = command_named(map::commands, "P").code;
inline constexpr unsigned DP = command_named(map::commands, "DP").code;
inline constexpr unsigned C = command_named(map::commands, "C").code;
inline constexpr unsigned LP = command_named(map::commands, "LP").code;
inline constexpr unsigned EP = command_named(map::commands, "EP").code;
inline constexpr unsigned COMP_PLUS = command_named(map::commands, "COMP_PLUS").code;
inline constexpr unsigned COMP_MINUS = command_named(map::commands, "COMP_MINUS").code;
inline constexpr unsigned AO = command_named(map::commands, "AO").code;
inline constexpr unsigned L = command_named(map::commands, "L").code;
inline constexpr unsigned NOP = command_named(map::commands, "NOP").code;
inline constexpr unsigned READ_LP = command_named(map::commands, "READ_LP").code;
inline constexpr unsigned READ_EP = command_named(map::commands, "READ_EP").code;
inline constexpr unsigned READ_CV = command_named(map::commands, "READ_CV").code;
inline constexpr unsigned READ_CA = command_named(map::commands, "READ_CA").code;
inline constexpr unsigned READ_BR = command_named(map::commands, "READ_BR").code;
inline constexpr unsigned FIXED_PLUS = command_named(map::commands, "FIXED_PLUS").code;
inline constexpr unsigned FIXED_MINUS = command_named(map::commands, "FIXED_MINUS").code;
inline constexpr unsigned CONTINUOUS_PLUS = command_named(map::commands, "CONTINUOUS_PLUS").code;
inline constexpr unsigned CONTINUOUS_MINUS = command_named(map::commands, "CONTINUOUS_MINUS").code;
inline constexpr unsigned HOLD = command_named(map::commands, "HOLD").code;
inline constexpr unsigned START = command_named(map::commands, "START").code;
inline constexpr unsigned SLOW_STOP = command_named(map::commands, "SLOW_STOP").code;
inline constexpr unsigned QUICK_STOP = command_named(map::commands, "QUICK_STOP").code;
inline constexpr unsigned LINE2 = command_named(map::commands, "LINE2").code;
inline constexpr unsigned LINE3 = command_named(map::commands, "LINE3").code;
inline constexpr unsigned ARC_CW = command_named(map::commands, "ARC_CW").code;
inline constexpr unsigned ARC_CCW = command_named(map::commands, "ARC_CCW").code;
inline constexpr unsigned BP2 = command_named(map::commands, "BP2").code;
inline constexpr unsigned BP3 = command_named(map::commands, "BP3").code;
inline constexpr unsigned BP_ENABLE = command_named(map::commands, "BP_ENABLE").code;
inline constexpr unsigned BP_DISABLE = command_named(map::commands, "BP_DISABLE").code;
inline constexpr unsigned BP_STACK = command_named(map::commands, "BP_STACK").code;
inline constexpr unsigned BP_CLEAR = command_named(map::commands, "BP_CLEAR").code;
inline constexpr unsigned STEP = command_named(map::commands, "STEP").code;
inline constexpr unsigned DECELERATION_ON = command_named(map::commands, "DECELERATION_ON").code;
inline constexpr unsigned DECELERATION_OFF = command_named(map::commands, "DECELERATION_OFF").code;
inline constexpr unsigned INTERPOLATION_INTERRUPT_CLEAR =
    command_named(map::commands, "INTERPOLATION_INTERRUPT_CLEAR").code;
inline constexpr unsigned EM = command_named(map::commands, "EM").code;
inline constexpr unsigned HV = command_named(map::commands, "HV").code;
inline constexpr unsigned HOME = command_named(map::commands, "HOME").code;
inline constexpr unsigned DCC = command_named(map::commands, "DCC").code;
inline constexpr unsigned SM = command_named(map::commands, "SM").code;
inline constexpr unsigned SYNC = command_named(map::commands, "SYNC").code;
}  // namespace cmd

/// Returns a field of a register by name; undeclared names do not compile: field("RR0", "CNEXT").test(word).
consteval Field field(std::string_view reg_name, std::string_view field_name) {
    return {mask_of(register_named(map::registers, reg_name), field_name)};
}

namespace map {

inline constexpr StateInfo drive_states[] = {
    {"idle", "idle; no pulses"},
    {"held", "a drive command waits for START"},
    {"starting", "250 ns from the command to the generator's first tick"},
    {"driving", "pulses; the speed approaches V"},
    {"final", "the speed decreases to SV for the end"},
    {"in_position", "all pulses sent; waits for nINPOS"},
};
inline constexpr TransitionInfo drive_transitions[] = {
    {"idle", "starting", "drive command"},
    {"idle", "held", "drive command after HOLD"},
    {"held", "starting", "START"},
    {"held", "idle", "stop command"},
    {"held", "driving", "the interpolation of another axis uses it"},
    {"idle", "driving", "a queued segment uses it"},
    {"starting", "driving", "two ticks have passed"},
    {"driving", "final", "remaining pulses, DP, decelerating stop"},
    {"driving", "in_position", "P pulses are out, the segment's last pulse with nothing queued, or an immediate stop"},
    {"final", "in_position", "P pulses are out, or SV is reached by a stop"},
    {"in_position", "idle", "nINPOS active or not enabled"},
    {"in_position", "starting", "drive command"},
    {"in_position", "driving", "a queued segment uses it"},
    {"in_position", "held", "drive command after HOLD"},
};
inline constexpr StateInfo chain_states[] = {
    {"idle", "no interpolation"},
    {"running", "a segment runs, CNEXT = 1; or a bit pattern, CNEXT = 0"},
    {"queued", "a segment runs and the next one waits, CNEXT = 0"},
};
inline constexpr TransitionInfo chain_transitions[] = {
    {"idle", "running", "command 30h .. 35h"},
    {"running", "queued", "command 30h .. 33h; not while a bit pattern runs"},
    {"queued", "running", "the running segment's last pulse: the queued one takes over, interrupt if CIINT"},
    {"running", "idle", "the segment's last pulse, or a stop"},
    {"queued", "idle", "a stop: the queued segment is dropped"},
};
inline constexpr StateInfo pattern_states[] = {
    {"idle", "no word runs"},
    {"running", "the bits of a word are stepped, D0 first"},
    {"stopped", "a stop came within a word; the remaining bits are kept"},
};
inline constexpr TransitionInfo pattern_transitions[] = {
    {"idle", "running", "command 34h or 35h: the oldest stacked word"},
    {"running", "running", "D15 is done: the oldest stacked word"},
    {"running", "idle", "end code; D15 is done and nothing is stacked; command 39h"},
    {"running", "stopped", "a stop"},
    {"stopped", "running", "command 34h or 35h: the rest of the word"},
    {"stopped", "idle", "command 39h"},
};
inline constexpr StateInfo stack_states[] = {
    {"0", "no word waits"},
    {"1", "one word waits"},
    {"2", "two words wait"},
    {"3", "full; command 38h is ignored"},
};
inline constexpr TransitionInfo stack_transitions[] = {
    {"0", "1", "command 38h"},
    {"1", "2", "command 38h"},
    {"2", "3", "command 38h"},
    {"3", "2", "the oldest word begins to run"},
    {"2", "1", "the oldest word begins to run; interrupt if BPINT"},
    {"1", "0", "the oldest word begins to run; end code; command 39h"},
    {"2", "0", "end code; command 39h"},
    {"3", "0", "end code; command 39h"},
};
inline constexpr StateInfo step_states[] = {
    {"free", "basic pulses are automatic, or no interpolation runs"},
    {"waiting", "the next basic pulse must be requested"},
    {"stepping", "a basic pulse is requested and pending"},
};
inline constexpr TransitionInfo step_transitions[] = {
    {"free", "waiting", "a segment starts with CMPLS or EXPLS set"},
    {"waiting", "stepping", "command 3Ah, or EXPLSN Low at two ticks"},
    {"stepping", "waiting", "the basic pulse"},
    {"stepping", "free", "the last basic pulse, or a stop"},
    {"waiting", "free", "a stop"},
};
inline constexpr StateInfo wire_states[] = {
    {"off", "EXOP disables driving by the input"},
    {"low", "the input is Low and its action is done, or it has not been High yet"},
    {"high", "waits for a falling edge"},
    {"falling", "Low at one tick"},
};
inline constexpr TransitionInfo wire_transitions[] = {
    {"off", "low", "EXOP 1 or 2"},
    {"low", "high", "High at a tick; EXOP 1: the drive that this input began is decelerated"},
    {"high", "falling", "Low at a tick"},
    {"falling", "high", "High at a tick"},
    {"falling", "low", "Low at a second tick; EXOP 1: continuous drive, EXOP 2: fixed drive"},
    {"low", "off", "EXOP 0 or 3"},
    {"high", "off", "EXOP 0 or 3"},
    {"falling", "off", "EXOP 0 or 3"},
};
inline constexpr MachineInfo machines[] = {
    {"drive", "one axis' drive; RESET leads from every state to idle", drive_states, drive_transitions},
    {"continuous interpolation", "the running segment and the next one; RESET leads from every state to idle",
     chain_states, chain_transitions},
    {"bit pattern", "the bit-pattern word in execution; RESET leads from every state to idle", pattern_states,
     pattern_transitions},
    {"bit-pattern stack", "number of stacked words (BPSC); RESET leads from every state to 0", stack_states,
     stack_transitions},
    {"single steps", "basic pulses on request; RESET leads from every state to free", step_states, step_transitions},
    {"drive by wire", "each of nEXPP and nEXPM; RESET leads from every state to off", wire_states, wire_transitions},
    {"home search", "MCX314As: one axis' automatic home search; RESET and stops lead from every state to idle",
     home_states, home_transitions},
    {"input filter", "MCX314As: one filtered input; 60h without its FE bit and RESET lead to same", filter_states,
     filter_transitions},
    {"deviation counter clear", "MCX314As: the clear pulse of one axis", clear_states, clear_transitions},
    {"synchronous action", "MCX314As: one axis' conditions", action_states, action_transitions},
};
static_assert(declared<machines_flaw(machines)>());

inline constexpr PinDirection in = PinDirection::input, out = PinDirection::output;
inline constexpr PinInfo pins[] = {
    {"*pp", out, false, "pulses in + direction, or pulses where PLSMD is set"},
    {"*pm", out, false, "pulses in - direction, or the direction where PLSMD is set"},
    {"*eca", in, false, "encoder line A"},
    {"*ecb", in, false, "encoder line B"},
    {"*in0", in, true, "stop input, level by WR1"},
    {"*in1", in, true, "stop input, level by WR1"},
    {"*in2", in, true, "stop input, level by WR1; usually the encoder's index"},
    {"*in3", in, true, "stop input, level by WR1"},
    {"*lmtp", in, true, "+ limit switch, level by WR2"},
    {"*lmtm", in, true, "- limit switch, level by WR2"},
    {"*alarm", in, true, "alarm of the drive, level by WR2"},
    {"*inpos", in, true, "in-position of the drive, level by WR2"},
    {"*expp", in, true, "drives in + direction where EXOP says so, or a hand wheel's line A"},
    {"*expm", in, true, "drives in - direction where EXOP says so, or a hand wheel's line B"},
    {"*drive", out, false, "High while the axis drives; MCX314As with DCCE: deviation counter clear"},
    {"*out0", out, false, "general output, WR4"},
    {"*out1", out, false, "general output, WR4"},
    {"*out2", out, false, "general output, WR4"},
    {"*out3", out, false, "general output, WR4"},
    {"*out4", out, false, "general output, WR3, or CMP+"},
    {"*out5", out, false, "general output, WR3, or CMP-"},
    {"*out6", out, false, "general output, WR3, or accelerating"},
    {"*out7", out, false, "general output, WR3, or decelerating"},
    {"emgn", in, true, "emergency stop of all axes"},
    {"expls_n", in, true, "one interpolation step where EXPLS says so"},
    {"int_n", out, true, "interrupt"},
};
static_assert(declared<pins_flaw(pins)>());

inline constexpr CardMap card = {"mcx314",  "Four-axis pulse chip with linear, circular and continuous interpolation",
                                 registers, commands,
                                 machines,  pins};

}  // namespace map

/// Returns the whole map, for documents, inspectors and traces.
inline const CardMap& card_map() {
    return map::card;
}

}  // namespace motionrack::mcx314
