// G codes that act once: dwell, offsets (G10), the shift G92 and reference points (G28, G30).
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class NonmodalWords : public MoveReader {
  public:
    using MoveReader::MoveReader;

    bool read();

  private:
    bool dwell();
    bool shift();
    bool reference();
};

}  // namespace motionrack::control::gcode
