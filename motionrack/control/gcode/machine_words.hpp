// Words for the rest of the machine: spindle, coolant, tool, overrides, stops, and saved modes.
#pragma once

#include <motionrack/control/gcode/word_reader.hpp>

namespace motionrack::control::gcode {

class MachineWords : public WordReader {
  public:
    using WordReader::WordReader;

    void apply_letters();                 ///< executes S and T
    bool change_tool();                   ///< M6
    bool set_tool();                      ///< M61
    bool set_spindle(std::int16_t code);  ///< M3 .. M5
    bool set_coolant(std::int16_t code);  ///< M7 .. M9
    bool overrides(std::int16_t code);    ///< M48 .. M53
    bool stop(std::int16_t code);         ///< M0 M1 M2 M30 M60
    bool save_modes(std::int16_t code);   ///< M70, M71, M73
    bool restore_saved();                 ///< M72
    /// M98 P L and M99 must be alone on the line; ProgramFlow executes them.
    bool check_program();
    /// Restores the modes `saved` by M70 or M73.
    void restore(const ModalState& saved);
};

}  // namespace motionrack::control::gcode
