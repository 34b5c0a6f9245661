// What a program does, one thing after the other: a move, or an event between moves.
#pragma once

#include <cstdint>
#include <motionrack/control/move.hpp>
#include <string_view>

namespace motionrack::control::gcode {

enum class StepKind : std::uint8_t {
    move,            ///< `move`; it may end where it starts (length 0)
    comment,         ///< `text`
    message,         ///< `text`, of (MSG,text): to be shown to the operator
    spindle_speed,   ///< S: `speed_rpm`
    spindle,         ///< M3 M4 M5: `spindle` at `speed_rpm`
    coolant,         ///< M7 M8 M9: `mist`, `flood` as they are from now on
    tool_select,     ///< T: `tool`
    tool_change,     ///< M6: `tool`
    tool_number,     ///< M61: `tool` is the one in the spindle; nothing is changed
    pause,           ///< M0, M60: stop until the operator goes on
    optional_pause,  ///< M1: the same where the operator has asked for it
    end              ///< M2, M30: the program is over; spindle and coolant off
};

enum class Spindle : std::uint8_t { off, clockwise, counter_clockwise };

struct Step {
    StepKind kind = StepKind::move;
    Spindle spindle = Spindle::off;
    bool mist = false;
    bool flood = false;
    std::int32_t line = 0;  ///< line of the source, from 1
    std::int32_t tool = 0;
    double speed_rpm = 0;
    std::string_view text;  ///< into the program's text
    Move move;
};

}  // namespace motionrack::control::gcode
