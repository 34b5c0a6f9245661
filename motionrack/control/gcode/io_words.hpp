// M62 .. M68: numbered outputs and inputs. They are not connected here: inputs are always 0, as in LinuxCNC.
#pragma once

#include <motionrack/control/gcode/word_reader.hpp>

namespace motionrack::control::gcode {

class IoWords : public WordReader {
  public:
    using WordReader::WordReader;

    /// Runs after all other words of the line, so that remaining words belong to these codes.
    bool read();

  private:
    bool read_input();
    bool port_number(char letter, char other);
};

}  // namespace motionrack::control::gcode
