// What a Grbl makes of a line that the machine's reader understands otherwise.
#pragma once

#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/grbl/numbers.hpp>
#include <string>

namespace motionrack::grbl {

/// Grbl's words are fewer than those of the machine's reader. `axes`: that are shown.
bool grbl_has(const control::gcode::Block& block, int axes);
/// What Grbl does only when all motion before it is done.
bool must_stand_first(const control::gcode::Block& block, const control::gcode::Interpreter& interpreter, bool laser);

/// A jog's target and feed; or `error`, one of Grbl's numbers.
struct JogLine {
    int error = error_none;
    control::Point target = {};
    double feed = 0;
};
/// $J=G91 G21 X10 F600. What it means is read by a copy of the reader, so that it leaves no traces.
JogLine read_jog(const std::string& text, control::gcode::Interpreter reader, int axes);

}  // namespace motionrack::grbl
