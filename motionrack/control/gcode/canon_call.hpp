// Canonical calls: the output of the interpreter, one move or event at a time.
#pragma once

#include <cstdint>
#include <motionrack/control/move.hpp>
#include <string_view>

namespace motionrack::control::gcode {

enum class CanonCallKind : std::uint8_t {
    move,            ///< `move`; it may end where it starts (length 0)
    comment,         ///< `text`
    message,         ///< `text` of (MSG,text), for the operator
    spindle_speed,   ///< S: `speed_rpm`
    spindle,         ///< M3 M4 M5: `spindle` at `speed_rpm`
    coolant,         ///< M7 M8 M9: new state of `mist` and `flood`
    tool_select,     ///< T: `tool`
    tool_change,     ///< M6: `tool`
    tool_number,     ///< M61: `tool` is the one in the spindle; no tool change
    overrides,       ///< M48 .. M53: `port` is the M code, `value` the new state
    output,          ///< M62 .. M65, M67, M68: sets output `port` to `value`
    input,           ///< M66: input `port` was read, or waited for, and has `value`
    pause,           ///< M0, M60: stop until the operator resumes
    optional_pause,  ///< M1: as pause, if the operator has enabled it
    end              ///< M2, M30: end of the program; spindle and coolant off
};

enum class Spindle : std::uint8_t { off, clockwise, counter_clockwise };

/// Stop condition of a probing move (G38.2 .. G38.5); without it the move runs to its end.
enum class Probe : std::uint8_t {
    none,
    contact,     ///< G38.2: stops when the probe touches; an error if it does not
    contact_if,  ///< G38.3: as contact, but no error if the probe does not touch
    release,     ///< G38.4: stops when the probe leaves; an error if it does not
    release_if   ///< G38.5: as release, but no error if the probe does not leave
};
constexpr bool probe_leaves(Probe probe) {
    return probe == Probe::release || probe == Probe::release_if;
}
constexpr bool probe_must(Probe probe) {
    return probe == Probe::contact || probe == Probe::release;
}

struct CanonCall {
    CanonCallKind kind = CanonCallKind::move;
    Probe probe =
        Probe::none;  ///< move: the next lines start at its final position, see Interpreter::set_probe_result()
    Spindle spindle = Spindle::off;
    bool mist = false;
    bool flood = false;
    bool overridable = true;    ///< subject to the overrides (M48, M50 P1); end: the feed override was enabled
    bool analog = false;        ///< output, input: analog (E word); false: digital (P word)
    bool with_motion = false;   ///< output: set at the start of the next move (M62, M63, M67), without a stop
    bool awaits_input = false;  ///< dwell: waits for an input (M66)
    std::int32_t line = 0;      ///< line of the source, from 1
    std::int32_t tool = 0;
    std::int32_t port = 0;  ///< output, input: number of the port, from 0
    double value = 0;       ///< output: 0 or 1 if not analog; input: -1 after a timeout
    double speed_rpm = 0;
    std::string_view text;  ///< points into the program text
    Move move;
};

/// Returns true if the axes must stand still before the call is executed.
constexpr bool needs_standstill(const CanonCall& step) {
    return step.kind == CanonCallKind::tool_change || step.kind == CanonCallKind::pause ||
           step.kind == CanonCallKind::end || step.kind == CanonCallKind::input ||
           (step.kind == CanonCallKind::output && !step.with_motion);
}

}  // namespace motionrack::control::gcode
