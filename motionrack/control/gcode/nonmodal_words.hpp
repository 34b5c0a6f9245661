// G codes that act once: dwell, the shift G92 and reference points (G28, G30).
#pragma once

#include <motionrack/control/gcode/move_reader.hpp>

namespace motionrack::control::gcode {

class NonmodalWords : public MoveReader {
  public:
    using MoveReader::MoveReader;

    bool dwell();                   ///< G4
    bool move_to_reference();       ///< G28, G30
    bool store_first_reference();   ///< G28.1
    bool store_second_reference();  ///< G30.1
    bool shift();                   ///< G92
    bool forget_shift();            ///< G92.1
    bool suspend_shift();           ///< G92.2
    bool restore_shift();           ///< G92.3

  private:
    bool takes_no_axis_words();
};

}  // namespace motionrack::control::gcode
