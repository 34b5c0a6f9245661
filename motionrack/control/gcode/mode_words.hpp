// Values of words that no code allows, and the words that change the modal state.
#pragma once

#include <motionrack/control/gcode/word_reader.hpp>

namespace motionrack::control::gcode {

class ModeWords : public WordReader {
  public:
    using WordReader::WordReader;

    /// Checks the signs, the axes, and the N and T words.
    bool check();
    /// Applies the modal G codes.
    bool apply();
    void apply_feed();

  private:
    bool negative_handles() const;
};

}  // namespace motionrack::control::gcode
