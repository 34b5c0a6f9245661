// All parameters that a program can read: its own, and the state of the machine.
//
//     5061..5070  position and success of the last probing move   5220        work system: 1 is G54 .. 9 is G59.3
//     5161..5169  target of G28                                   5221..5230  G54: X Y Z A B C U V W, rotation
//     5181..5189  target of G30                                   5241..5390  G55 to G59.3, as G54
//     5210..5219  G92: enabled, and the shift                     5400..5413  tool in the spindle: number, offsets, ..
//                                                                 5420..5428  position in program coordinates
//
// Lengths are mm, except for 5061.. and 5420.., which are in program coordinates and units. 5061.. are ordinary
// parameters that each probing move sets. Names: those of LinuxCNC that have a meaning here.
#pragma once

#include <motionrack/control/gcode/language/expression_parser.hpp>

namespace motionrack::control::gcode {

class Interpreter;

/// Reads the state of an interpreter after its last line.
class MachineParameters final : public ParameterSource {
  public:
    explicit MachineParameters(const Interpreter& interpreter) : interpreter_(interpreter) {}
    double numbered(int number) const override;
    std::optional<double> named(std::string_view name) const override;

    /// Returns true for parameters of the machine, which a program cannot set.
    static bool is_read_only(int number);
    static bool is_read_only(std::string_view name);

  private:
    const Interpreter& interpreter_;
};

}  // namespace motionrack::control::gcode
