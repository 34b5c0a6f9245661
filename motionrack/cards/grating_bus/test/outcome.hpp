// All that a random program shows, of the twin and of the cards alike, as lines of text in one order.
#pragma once

#include <cstddef>
#include <motionrack/cards/grating_bus/test/random_bus.hpp>
#include <string>
#include <vector>

namespace motionrack::grating_bus::twin {

struct Outcome {
    std::vector<std::string> frames;     ///< published, card by card
    std::vector<std::string> looks;      ///< registers and lines after each operation
    std::vector<std::string> conflicts;  ///< the last ones, in order
    std::vector<std::string> reports;    ///< bad frames, missed edges and stale data, card by card
    std::vector<std::string> changes;    ///< of wires, wire by wire; only while all are looked at
    std::size_t conflict_count = 0;
};

/// Who looks at single wires: that must not matter.
enum class Watch { nobody, everybody, now_and_then };

Outcome on_twin(const Program& program);
/// After operation `snapshot_at` the cards run on, and are put back.
Outcome on_cards(const Program& program, Watch watch, std::size_t snapshot_at);

/// Of so many conflicts, the first one that is compared: cards remember the last ones only.
std::size_t first_compared(std::size_t conflicts);
/// Numbers with blanks between them.
std::string row(std::initializer_list<std::int64_t> numbers);
/// Address and count of each word.
std::string words_of(const Frame& frame);

}  // namespace motionrack::grating_bus::twin
