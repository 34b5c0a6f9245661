// Detects empty programs: an incomplete copy, or the wrong file.
#pragma once

#include <motionrack/control/gcode/problem.hpp>
#include <string>
#include <string_view>

namespace motionrack::control::gcode {

/// Returns true if a text has only comments and blanks up to its closing '%'.
bool is_empty_program(std::string_view text);

/// Returns the error for such a program: completing it without an error could be mistaken for success.
Problem empty_program_problem(std::string_view text, const std::string& file);

}  // namespace motionrack::control::gcode
