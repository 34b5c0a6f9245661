// Status of an operated machine: one snapshot at one instant.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/control/homing.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::operate {

enum class MachineState : std::uint8_t {
    disabled,  ///< accepts no motion until an axis is enabled
    standstill,
    homing,
    moving,  ///< executes lines of G-code
    jogging,
    hold,  ///< feed hold of a program, which resume continues
    stopping,
    error_stop,  ///< stopped by the machine; a reset ends it
    service      ///< manual calls of a card's library functions; the controller drives nothing
};
/// Returns the name of the state as it is shown, such as "error stop" for error_stop.
std::string_view name_of(MachineState state);
/// Returns true if nothing moves and no motion is pending in this state.
constexpr bool idle(MachineState state) {
    return state == MachineState::disabled || state == MachineState::standstill || state == MachineState::error_stop;
}
/// Returns true if nothing moves in this state.
constexpr bool is_stationary(MachineState state) {
    return idle(state) || state == MachineState::hold;
}

/// An alarm with the states of ISA-18.2: active until its cause is gone, which for most a reset ends. Then it stays
/// listed until it is acknowledged.
struct Alarm {
    std::int64_t number = 0;  ///< starts at 1
    Instant at{};
    std::string source;  ///< "emergency stop", "part.ngc, line 12", "homing", "jog", "last run", "machine",
                         ///< "position", "following error", "stage", "journal"
    std::string text;
    bool active = true, acknowledged = false;
    bool stays = false;  ///< a reset does not end its cause
    char axis = '\0';    ///< axis that is invalid or has a following error; an alarm that stops the machine for it
                         ///< replaces this one
};

struct AxisStatus {
    char letter = 'X';
    bool rotary = false;          ///< degrees instead of mm
    bool position_valid = false;  ///< the positions are valid
    bool enabled = false;
    double commanded = 0;      ///< position by the card's pulses
    double actual = 0;         ///< position by the encoder; `commanded` without one
    double true_position = 0;  ///< true position of the table, independent of any counter
    double velocity = 0;       ///< per second, signed
    std::int64_t pulses = 0;   ///< counters of the card
    std::int64_t counts = 0;
};

/// Source and kind of a stop request.
struct StopOrigin {
    std::string who = {};      ///< "anna"; empty: unknown user
    std::string address = {};  ///< "192.168.1.5", "127.0.0.1:4711", a path; empty: this process itself
    std::string kind = {};     ///< "STOP", "Reset", "^X", "Disabling", "Shutdown"; empty: not reported
    bool operator==(const StopOrigin&) const = default;
};

/// A commanded stop or reset. A client that streams lines must not continue by itself afterwards: its next lines were
/// meant to follow the dropped ones.
struct StopReport {
    Instant at{};
    StopOrigin source;
    MachineState state = MachineState::standstill;  ///< state at the command
    std::string text;                               ///< "STOP by anna (192.168.1.5): line 12 was stopped."
    bool releases = false;                          ///< a reset at standstill: clients stopped before may continue
};

/// State of an axis when a machine is created.
struct InitialAxisState {
    char letter = 'X';
    double true_position = 0;  ///< true position of the table
    double commanded = 0;      ///< position by the card's counter
    bool position_valid = false;
};

struct Status {
    Instant at{};
    std::int64_t sequence = 0;  ///< number of this status, from 1
    MachineState state = MachineState::disabled;
    std::string reason;  ///< reason of the last stop, or of the hold
    std::vector<AxisStatus> axes;
    std::string program;    ///< name; empty: none started
    std::int32_t line = 0;  ///< current line
    std::int32_t lines = 0;
    bool program_runs = false, single_block = false;
    control::gcode::Spindle spindle = control::gcode::Spindle::off;  ///< state set by the last executed program or line
    double spindle_rpm = 0;
    bool mist = false, flood = false;
    double feed_override = 1, rapid_override = 1;
    std::vector<control::AxisHomingState> homing;  ///< progress of the last homing
    std::string service;                           ///< card in service; empty: none
    bool real = false;                             ///< the card in service is a real one, which moves
    std::vector<Alarm> alarms;                     ///< oldest first
    bool ended = false;                            ///< the last status of the run
};

}  // namespace motionrack::operate
