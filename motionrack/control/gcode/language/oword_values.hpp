// Values in brackets behind an O word: o100 call [1] [#2], o101 while [#1 LT 5].
#pragma once

#include <motionrack/control/gcode/interpreter.hpp>
#include <motionrack/control/gcode/language/oword_index.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::control::gcode {

/// A value that cannot be evaluated.
struct OWordFault {
    std::size_t column = 0;  ///< column of the error, from 0
    std::string message;
};

/// Evaluates the values up to the end of the line. Returns the fault if there is one; `values` has those before it.
std::optional<OWordFault> evaluate_values(const OWordLocation& location, std::size_t max_values,
                                          Interpreter& interpreter, std::vector<double>& values);
/// Evaluates the single value of a condition. Returns the fault if there is one.
std::optional<OWordFault> evaluate_condition(const OWordLocation& location, Interpreter& interpreter, double& value);

}  // namespace motionrack::control::gcode
