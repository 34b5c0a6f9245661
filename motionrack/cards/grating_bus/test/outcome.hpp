// Complete outcome of a random program, on the twin or the cards, most of it as lines of text in one order.
#pragma once

#include <cstddef>
#include <motionrack/cards/grating_bus/test/random_bus.hpp>
#include <string>
#include <tests/oracle/changes.hpp>
#include <vector>

namespace motionrack::grating_bus::twin {

struct Outcome {
    std::vector<std::string> frames;      ///< published, card by card
    std::vector<std::string> looks;       ///< registers and lines after each operation
    std::vector<std::string> conflicts;   ///< the last ones, in order
    std::vector<std::string> reports;     ///< bad frames, missed edges and stale data, card by card
    std::vector<oracle::Change> changes;  ///< changes of wires; only while all are watched
    std::size_t conflict_count = 0;
};

/// Listeners of single wires, which must have no effect.
enum class Watch { nobody, everybody, now_and_then };

Outcome on_twin(const Program& program);
Outcome on_cards(const Program& program, Watch watch);

/// The first conflict to be compared out of this number: cards store only the last ones.
std::size_t first_compared(std::size_t conflicts);
/// Numbers with blanks between them.
std::string row(std::initializer_list<std::int64_t> numbers);
/// Address and count of each word.
std::string words_of(const Frame& frame);

}  // namespace motionrack::grating_bus::twin
