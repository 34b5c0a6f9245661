// Words for the rest of the machine: spindle, coolant, tool, overrides, stops, and saved modes.
#pragma once

#include <motionrack/control/gcode/word_reader.hpp>

namespace motionrack::control::gcode {

class MachineWords : public WordReader {
  public:
    using WordReader::WordReader;

    bool apply();
    /// M98 P L and M99 must be alone on the line; ProgramFlow executes them.
    bool check_program();
    /// Restores modes that M70 or M73 saved.
    void restore(const ModalState& saved);

  private:
    bool overrides();
    bool set_tool();
};

}  // namespace motionrack::control::gcode
