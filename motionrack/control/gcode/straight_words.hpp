// G0, G1 and the probing moves G38.2 .. G38.5.
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class StraightWords : public MoveReader {
  public:
    using MoveReader::MoveReader;

    bool read(std::int16_t code);

  private:
    bool may_probe(std::int16_t code);
    bool probing(std::int16_t code);
};

}  // namespace motionrack::control::gcode
