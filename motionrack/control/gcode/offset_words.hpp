// Offsets of program coordinates: work offsets and rotation (G10 L2, L20), the tool table (G10 L1, L10, L11) and tool
// lengths (G43, G43.1, G43.2, G49).
#pragma once

#include <motionrack/control/gcode/word_reader.hpp>

namespace motionrack::control::gcode {

class OffsetWords : public WordReader {
  public:
    using WordReader::WordReader;

    bool set_offsets();
    bool tool_length();

  private:
    bool set_work_offset(int system, bool from_position);
    bool tool_length_of_words(bool adds);
    bool tool_length_of_table(bool adds);
    Point shift_to_words(const WorkFrame& frame) const;
    void shift_turned(WorkFrame& frame, int system);
    bool edit_tool(int what);
    bool edit_tool_shape(Tool& tool);
};

}  // namespace motionrack::control::gcode
