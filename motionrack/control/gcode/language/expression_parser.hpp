// Parser of G-code values as in LinuxCNC: numbers, parameters, expressions in brackets and functions.
//
//     X12.5   X#1   X-#<depth>   X[#1 + 2 * [#2 - 1]]   X SIN[30]   X ATAN[#2]/[#3]
//
// Operators from the strongest to the weakest, equal ones from left to right:
//     **     * / MOD     + -     EQ NE GT GE LT LE     AND OR XOR
// Comparisons return 1 or 0; EQ and NE treat numbers that differ by less than 0.0001 as equal. MOD is never negative.
// Angles are in degrees. Functions: ABS ACOS ASIN ATAN[]/[] COS EXISTS EXP FIX FUP LN ROUND SIN SQRT TAN.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace motionrack::control::gcode {

/// Parameters are #1 to #5602.
inline constexpr int last_parameter = 5602;
/// Maximum length of a parameter name, without blanks.
inline constexpr std::size_t max_name_length = 100;

/// Source of parameter values.
class ParameterSource {
  public:
    virtual ~ParameterSource() = default;
    /// Returns #number, 1 .. last_parameter; 0 if it was never set.
    virtual double numbered(int number) const = 0;
    /// Returns #<name>, given in lower case without blanks; nothing if it was never set.
    virtual std::optional<double> named(std::string_view name) const = 0;
};

/// Name of a parameter: the left side of an assignment, or the text after a '#'.
struct ParameterName {
    int number = 0;    ///< 1 .. last_parameter; 0: `name` is used
    std::string name;  ///< lower case, without blanks
};

/// Parses values in a line. After a method returned false, `fault_at` (from 0) and `fault` describe the error.
class ExpressionParser {
  public:
    ExpressionParser(std::string_view text, const ParameterSource& source)
        : text_(text), end_(text.data() + text.size()), source_(source) {}

    /// Returns true if a value other than a plain number starts at `at`: '#', '[', a function, or one of these after a
    /// sign.
    bool begins(const char* at) const;

    /// Parses a value, which is finite, and moves `at` behind it and the following blanks.
    bool value(const char*& at, double& value);

    /// Parses the parameter behind a '#', at which `at` must point.
    bool parameter(const char*& at, ParameterName& name);

    std::size_t fault_at() const { return fault_at_; }
    const std::string& fault() const { return fault_; }

  private:
    enum class Operator : unsigned char;

    bool bracket(const char*& at, double& value);
    bool operation(const char*& at, int weakest, double& value);
    bool unary(const char*& at, double& value);
    bool arc_tangent(const char*& at, double over, double& value);
    bool exists(const char*& at, double& value);
    bool apply(const char* at, Operator what, double& left, double right);
    bool finite(const char* at, double value);
    Operator operator_at(const char* at, const char*& after) const;
    void skip(const char*& at) const;
    bool fail(const char* at, std::string message);

    std::string_view text_;
    const char* end_;
    const ParameterSource& source_;
    int depth_ = 0;
    std::size_t fault_at_ = 0;
    std::string fault_;
};

}  // namespace motionrack::control::gcode
