// All parameters that a program may read: its own, and those that tell of the machine.
//
//     5061..5070  where the probe touched, and whether it did   5220        work system: 1 is G54 .. 9 is G59.3
//     5161..5169  where G28 goes                                5221..5230  G54: X Y Z A B C U V W, rotation
//     5181..5189  where G30 goes                                5241..5390  G55 and on to G59.3, each as G54
//     5210..5219  G92: whether it is on, and the shift          5400..5413  tool in the spindle: number, offsets, ..
//                                                               5420..5428  where the machine is in program coordinates
//
// Lengths are mm but for 5061.. and 5420.., which are in the program's coordinates and units; 5061.. are as any other
// parameter: each probing move sets them. Names: those of LinuxCNC that mean something here.
#pragma once

#include <motionrack/control/gcode/language/expression_parser.hpp>

namespace motionrack::control::gcode {

class Interpreter;

/// Looks at an interpreter as it is after its last line.
class MachineParameters final : public ParameterSource {
  public:
    explicit MachineParameters(const Interpreter& interpreter) : interpreter_(interpreter) {}
    double numbered(int number) const override;
    std::optional<double> named(std::string_view name) const override;

    /// Whether the machine sets a parameter, so that a program cannot.
    static bool is_read_only(int number);
    static bool is_read_only(std::string_view name);

  private:
    const Interpreter& interpreter_;
};

}  // namespace motionrack::control::gcode
