// Outcome of a random program on the twin or on the cards, mostly as lines of text in a fixed order for comparison.
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

/// Which single wires have listeners; listeners must not change the outcome.
enum class Watch { nobody, everybody, now_and_then };

Outcome on_twin(const Program& program);
Outcome on_cards(const Program& program, Watch watch);

/// Returns the index of the first conflict to compare, of this number: cards store only the last ones.
std::size_t first_compared(std::size_t conflicts);
/// Returns the numbers, each with a blank after it.
std::string row(std::initializer_list<std::int64_t> numbers);
/// Returns address and count of each word as text.
std::string words_of(const Frame& frame);

}  // namespace motionrack::grating_bus::twin
