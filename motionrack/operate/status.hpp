// What people see of a machine that they operate: one picture of it at one instant.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/base/time.hpp>
#include <motionrack/control/gcode/canon_call.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::operate {

enum class MachineState : std::uint8_t {
    disabled,  ///< takes no motion until an axis is enabled
    standstill,
    homing,
    moving,  ///< drives lines of G-code
    jogging,
    hold,  ///< stands in a program, which goes on with resume
    stopping,
    error_stop,  ///< stopped by the machine; reset ends it
    service      ///< somebody calls the functions of a card's library; the controller drives nothing
};
/// "standstill", "error stop".
std::string_view name_of(MachineState state);
/// Whether nothing moves in it and nothing waits to go on.
constexpr bool idle(MachineState state) {
    return state == MachineState::disabled || state == MachineState::standstill || state == MachineState::error_stop;
}
/// Whether nothing moves in it.
constexpr bool is_stationary(MachineState state) {
    return idle(state) || state == MachineState::hold;
}

/// An alarm as ISA-18.2 has them: it is there until it was acknowledged and its cause is gone.
struct Alarm {
    std::int64_t number = 0;  ///< from 1
    Instant at{};
    std::string source;  ///< "emergency stop", "part.ngc, line 12", "homing", "jog", "last run", "machine",
                         ///< "position", "following error", "stage", "journal"
    std::string text;
    bool active = true, acknowledged = false;
    bool stays = false;  ///< no reset ends its cause
    char axis = '\0';    ///< that is not trusted, or stays behind: an alarm that stops the machine for it replaces this
};

struct AxisStatus {
    char letter = 'X';
    bool rotary = false;          ///< degrees instead of mm
    bool position_valid = false;  ///< the positions mean places of the machine
    bool enabled = false;
    double commanded = 0;      ///< what the card's pulses say
    double actual = 0;         ///< what the encoder says; commanded without one
    double true_position = 0;  ///< where the table really is, whatever any counter says
    double speed = 0;          ///< a second, signed
    std::int64_t pulses = 0;   ///< the card's counters
    std::int64_t counts = 0;
};

/// Who asks for a stop, and how.
struct StopOrigin {
    std::string who = {};      ///< "anna"; empty: nobody who is known by name
    std::string address = {};  ///< "192.168.1.5", "127.0.0.1:4711", a path; empty: this program itself
    std::string kind = {};     ///< "STOP", "Reset", "^X", "Disabling", "Shutdown"; empty: nobody needs to hear of it
    bool operator==(const StopOrigin&) const = default;
};

/// A stop or a reset that was ordered. Who streams lines must not go on by itself afterwards: what it sends next was
/// meant to be driven behind what was dropped.
struct StopReport {
    Instant at{};
    StopOrigin source;
    MachineState state = MachineState::standstill;  ///< in which it came
    std::string text;                               ///< "STOP by anna (192.168.1.5): line 12 was stopped."
    bool releases = false;  ///< a reset of a machine that stood: who was stopped before may go on
};

/// Where an axis stands when a machine is made.
struct InitialAxisState {
    char letter = 'X';
    double true_position = 0;  ///< of the table
    double commanded = 0;      ///< as the card's counter has it
    bool position_valid = false;
};

struct Status {
    Instant at{};
    std::int64_t sequence = 0;  ///< of this picture, from 1
    MachineState state = MachineState::disabled;
    std::string reason;  ///< the sentence that stopped it last, or why it holds
    std::vector<AxisStatus> axes;
    std::string program;    ///< name; empty: none was begun
    std::int32_t line = 0;  ///< being driven
    std::int32_t lines = 0;
    bool program_runs = false, single_step = false;
    control::gcode::Spindle spindle = control::gcode::Spindle::off;  ///< as the last program or line has passed it
    double spindle_rpm = 0;
    bool mist = false, flood = false;
    double feed_override = 1, rapid_override = 1;
    std::string homing;         ///< "X SLOW_WAIT, Y HOMED": how far the last homing came
    std::string service;        ///< the card that is in service; empty: none
    bool real = false;          ///< it is a real one, which moves
    std::vector<Alarm> alarms;  ///< oldest first
};

}  // namespace motionrack::operate
