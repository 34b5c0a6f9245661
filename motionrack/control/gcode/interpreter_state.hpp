// Everything that an interpreter keeps from line to line, in parts with one owner each. A copy is independent.
#pragma once

#include <motionrack/control/gcode/cutter_state.hpp>
#include <motionrack/control/gcode/language/parameters.hpp>
#include <motionrack/control/gcode/lathe_cycle.hpp>
#include <motionrack/control/gcode/line_words.hpp>
#include <motionrack/control/gcode/modal_state.hpp>
#include <motionrack/control/gcode/offsets.hpp>
#include <motionrack/control/gcode/settings.hpp>
#include <motionrack/control/gcode/step_queue.hpp>
#include <motionrack/control/gcode/travel.hpp>
#include <optional>
#include <string>

namespace motionrack::control::gcode {

/// A lathe cycle that waits for its contour, the moves of the sub `label`.
struct ContourRequest {
    std::optional<LatheCycle> cycle;
    std::string label;
};

struct InterpreterState {
    Settings settings;
    LineWords words;
    Modes modes;
    Offsets offsets;
    Travel travel;
    Parameters parameters;
    CutterState cutter;
    ContourRequest contour;
    StepQueue steps;

    /// Returns the next call of the last line, valid until the next pull(); null if there is none.
    const CanonCall* pull() { return steps.next({words, modes, offsets, travel, cutter.held()}); }
};

}  // namespace motionrack::control::gcode
