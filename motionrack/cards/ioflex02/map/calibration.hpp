// Calibration of an axis: the source's commands and statuses, and the state table that connects them and that the model
// executes.
//
//              cNop, cRes            cResNm              cResNmSig
//                  │                    │                    │
//                  ▼       index        ▼       Cal rises    ▼
//             [calibrated] ◄────── [wait index] ◄─────── [wait cal]
//              sCal                  sNotCal               sNotCal
#pragma once

#include <cstdint>
#include <motionrack/base/commands.hpp>
#include <motionrack/base/states.hpp>

namespace motionrack::ioflex02 {

/// Command of one axis, named as in the source.
enum tIOFlexCmd : std::uint8_t { cNop, cRes, cResNm, cResNmSig };
/// Status of one axis, named as in the source.
enum tIOFlexSts : std::uint8_t { sNotCal, sCal };

enum class CalState : std::uint8_t { calibrated, wait_index, wait_cal };
/// The four commands in order, then the events of the encoder.
enum class CalEvent : std::uint8_t { nop, res, res_nm, res_nm_sig, index, cal };

struct CalStep {
    CalState next = CalState::calibrated;
    bool zero = false;  ///< sets the position to 0
};

/// [state][event]; an event without a rule leaves the state unchanged.
struct CalTable {
    static constexpr CalStep done{CalState::calibrated, false}, zero{CalState::calibrated, true};
    static constexpr CalStep index{CalState::wait_index, false}, cal{CalState::wait_cal, false};
    static constexpr CalStep steps[3][6] = {
        //              cNop  cRes  cResNm cResNmSig  index  Cal rises
        /* calibrated */ {done, zero, index, cal, done, done},
        /* wait index */ {done, zero, index, cal, zero, index},
        /* wait cal   */ {done, zero, index, cal, cal, index},
    };
};

constexpr CalStep calibration_step(CalState state, CalEvent event) {
    return CalTable::steps[static_cast<int>(state)][static_cast<int>(event)];
}
constexpr tIOFlexSts status_of(CalState state) {
    return state == CalState::calibrated ? sCal : sNotCal;
}

namespace map {

inline constexpr CommandInfo commands[] = {
    {"cNop", cNop, 0, 0, 0, "", "", "no calibration; cancels a pending one, the position stays"},
    {"cRes", cRes, 0, 0, 0, "", "", "the position becomes 0 at once"},
    {"cResNm", cResNm, 0, 0, 0, "", "", "the position becomes 0 at the first index pulse"},
    {"cResNmSig", cResNmSig, 0, 0, 0, "", "", "the position becomes 0 at the first index pulse after Cal has risen"},
};
static_assert(declared<commands_flaw(commands)>());

inline constexpr StateInfo calibration_states[] = {
    {"calibrated", "sCal: no calibration is pending"},
    {"wait index", "sNotCal: the next index pulse zeroes the position"},
    {"wait cal", "sNotCal: waits for a rising edge of Cal; index pulses have no effect"},
};
inline constexpr TransitionInfo calibration_transitions[] = {
    {"calibrated", "wait index", "cResNm"},
    {"calibrated", "wait cal", "cResNmSig"},
    {"wait index", "calibrated", "index pulse (the position becomes 0), cRes, cNop"},
    {"wait index", "wait cal", "cResNmSig"},
    {"wait cal", "wait index", "rising edge of Cal, cResNm"},
    {"wait cal", "calibrated", "cRes, cNop"},
};
inline constexpr StateInfo array_states[] = {
    {"empty", "no project: the project's registers read FFFFh"},        {"loading", "the image's bytes are accepted"},
    {"starting", "the image is complete; the array configures itself"}, {"running", "the project works"},
    {"failed", "the image was refused: CFG_ERROR has the reason"},
};
inline constexpr TransitionInfo array_transitions[] = {
    {"empty", "loading", "CONFIGURE"},
    {"loading", "starting", "the last byte, and the image is valid"},
    {"loading", "failed", "the image is invalid, or END before its last byte"},
    {"starting", "running", "the time of configuration is over"},
    {"starting", "loading", "CONFIGURE"},
    {"running", "loading", "CONFIGURE"},
    {"failed", "loading", "CONFIGURE"},
};
inline constexpr MachineInfo machines[] = {
    {"array", "the programmable array; power-up leads to empty", array_states, array_transitions},
    {"calibration", "of each axis; a reset leads to calibrated", calibration_states, calibration_transitions},
};
static_assert(declared<machines_flaw(machines)>());
/// True if an event leads from one state of the calibration to the other; both are indices.
constexpr bool calibration_leads(std::size_t from, std::size_t to) {
    for (const CalStep& each : CalTable::steps[from])
        if (static_cast<std::size_t>(each.next) == to) return true;
    return false;
}
static_assert(declared<transitions_flaw(machine_named(machines, "calibration"), calibration_leads)>());

}  // namespace map
}  // namespace motionrack::ioflex02
