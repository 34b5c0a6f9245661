// G73, G74, G81 .. G86, G89: from words to a checked plan of the holes.
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class DrillWords : public MoveReader {
  public:
    using MoveReader::MoveReader;

    bool read(std::int16_t code);

  private:
    bool allows(std::int16_t code);
    bool cycle_words(std::int16_t code);
    bool spindle_turns(std::int16_t code);
    bool cycle_heights(DrillCycle& plan);
    bool pecks_go(const DrillCycle& plan);
    bool cycle_within_limits(DrillCycle& plan);
    bool cycle_places(DrillCycle& plan);
    bool cycle_places_turned(DrillCycle& plan);
};

}  // namespace motionrack::control::gcode
