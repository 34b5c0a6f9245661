// Grbl's rules for lines that the machine's reader interprets differently.
#pragma once

#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/grbl/numbers.hpp>
#include <string>

namespace motionrack::grbl {

/// Returns true if Grbl supports all words of the block; it has fewer than the machine's reader. `axes`: number of
/// reported axes.
bool grbl_has(const control::gcode::Block& block, int axes);
/// Returns true if Grbl executes the block only after all previous motion.
bool must_stand_first(const control::gcode::Block& block, const control::gcode::Interpreter& interpreter, bool laser);

/// Returns true if a line that the interpreter has just read moves an axis or switches something on.
bool starts_something(control::gcode::Interpreter& read);

/// Target (machine coordinates) and feed rate of a jog; or `error`, a Grbl error number.
struct JogLine {
    int error = error_none;
    control::Point target = {};
    double feed = 0;
};
/// Parses $J=G91 G21 X10 F600. Works on a copy of the interpreter, so that its state does not change.
JogLine read_jog(const std::string& text, control::gcode::Interpreter reader, int axes);

}  // namespace motionrack::grbl
