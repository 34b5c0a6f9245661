// A program in which nothing is written: a copy that went wrong, or the wrong file.
#pragma once

#include <motionrack/control/gcode/problem.hpp>
#include <string>
#include <string_view>

namespace motionrack::control::gcode {

/// Whether a text has nothing but comments and blanks up to its closing '%'.
bool is_empty_program(std::string_view text);

/// What is wrong with such a program: to run it and call it done would be taken for success.
Problem empty_program_problem(std::string_view text, const std::string& file);

}  // namespace motionrack::control::gcode
