// The motion of a line: which code its axis words belong to.
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class MotionWords : public MoveReader {
  public:
    using MoveReader::MoveReader;

    bool read();

  private:
    bool motion_needs(std::int16_t code, bool wants_motion);
};

}  // namespace motionrack::control::gcode
