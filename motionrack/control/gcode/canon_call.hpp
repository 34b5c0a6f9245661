// What a program does, one thing after the other: a move, or an event between moves.
#pragma once

#include <cstdint>
#include <motionrack/control/move.hpp>
#include <string_view>

namespace motionrack::control::gcode {

enum class CanonCallKind : std::uint8_t {
    move,            ///< `move`; it may end where it starts (length 0)
    comment,         ///< `text`
    message,         ///< `text`, of (MSG,text): to be shown to the operator
    spindle_speed,   ///< S: `speed_rpm`
    spindle,         ///< M3 M4 M5: `spindle` at `speed_rpm`
    coolant,         ///< M7 M8 M9: `mist`, `flood` as they are from now on
    tool_select,     ///< T: `tool`
    tool_change,     ///< M6: `tool`
    tool_number,     ///< M61: `tool` is the one in the spindle; nothing is changed
    overrides,       ///< M48 .. M53: `port` is the M code, `value` whether what it governs is on
    output,          ///< M62 .. M65, M67, M68: output `port` goes to `value`
    input,           ///< M66: input `port` was looked at, or waited for, and gave `value`
    pause,           ///< M0, M60: stop until the operator goes on
    optional_pause,  ///< M1: the same where the operator has asked for it
    end              ///< M2, M30: the program is over; spindle and coolant off
};

enum class Spindle : std::uint8_t { off, clockwise, counter_clockwise };

/// What a probing move (G38.2 .. G38.5) waits for; it goes to its end where that does not come.
enum class Probe : std::uint8_t {
    none,
    contact,     ///< G38.2: stops where the probe touches; an error if it does not
    contact_if,  ///< G38.3: no error
    release,     ///< G38.4: stops where the probe leaves; an error if it does not
    release_if   ///< G38.5: no error
};
constexpr bool probe_leaves(Probe probe) {
    return probe == Probe::release || probe == Probe::release_if;
}
constexpr bool probe_must(Probe probe) {
    return probe == Probe::contact || probe == Probe::release;
}

struct CanonCall {
    CanonCallKind kind = CanonCallKind::move;
    Probe probe = Probe::none;  ///< of a move; the lines after it begin where the machine stands then:
                                ///< Interpreter::set_probe_result()
    Spindle spindle = Spindle::off;
    bool mist = false;
    bool flood = false;
    bool overridable = true;    ///< the operator's overrides count (M48, M50 P1); of the end: until there
    bool analog = false;        ///< of an output or input: E, not P
    bool with_motion = false;   ///< of an output: at the beginning of the next move (M62, M63, M67), without a stop
    bool awaits_input = false;  ///< of a dwell: it is M66 that waits
    std::int32_t line = 0;      ///< line of the source, from 1
    std::int32_t tool = 0;
    std::int32_t port = 0;  ///< of an output or input, from 0
    double value = 0;  ///< of an output: 0 or 1 where it is not analog; of an input: -1 where it did not come in time
    double speed_rpm = 0;
    std::string_view text;  ///< into the program's text
    Move move;
};

/// Whether the machine stands still for it.
constexpr bool needs_standstill(const CanonCall& step) {
    return step.kind == CanonCallKind::tool_change || step.kind == CanonCallKind::pause ||
           step.kind == CanonCallKind::end || step.kind == CanonCallKind::input ||
           (step.kind == CanonCallKind::output && !step.with_motion);
}

}  // namespace motionrack::control::gcode
