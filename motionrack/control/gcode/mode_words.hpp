// Values of words that no code allows, and the words that change the modal state.
#pragma once

#include <motionrack/control/gcode/word_reader.hpp>

namespace motionrack::control::gcode {

class ModeWords : public WordReader {
  public:
    using WordReader::WordReader;

    /// Checks the signs, the axes, and the N and T words.
    bool check();
    bool set_feed_mode(std::int16_t code);  ///< G93, G94
    bool set_system(std::int16_t code);     ///< G54 .. G59.3
    bool set_path(std::int16_t code);       ///< G61, G61.1, G64
    void apply_feed();

  private:
    bool negative_handles() const;
};

}  // namespace motionrack::control::gcode
