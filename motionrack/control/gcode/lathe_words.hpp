// G70 .. G72.2: from words to a plan, and from the contour of a sub to moves.
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class LatheWords : public MoveReader {
  public:
    using MoveReader::MoveReader;

    /// Reads the words of the cycle. turn() makes its moves when the contour is known.
    bool read(std::int16_t code);
    /// Makes the moves of the lathe cycle from its contour. On an error the line has no moves.
    Outcome<void> turn(std::vector<ContourSegment> contour);

  private:
    bool turning_allowed(std::int16_t code);
    bool turning_words(std::int16_t code, LatheCycle& plan);
    bool turning_within_limits(const std::vector<LatheMove>& moves);
};

}  // namespace motionrack::control::gcode
