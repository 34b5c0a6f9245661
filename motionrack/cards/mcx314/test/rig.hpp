// Runs a register program on a chip and writes down all that a host and a motor could see.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/mcx314/test/program.hpp>
#include <string>
#include <vector>

namespace motionrack::mcx314::twin {

/// What is seen right after an op (for a read: with its value).
struct Sight {
    std::uint16_t value = 0;
    bool interrupt = false;
    std::array<std::int64_t, axis_count> count{};
    friend bool operator==(const Sight&, const Sight&) = default;
};

struct Outcome {
    std::vector<Sight> sights;   ///< one an op
    std::vector<Pulse> pulses;   ///< by tick, then axis; only if they were listened to
};

/// How a program is run: all ways must give the same outcome.
struct Way {
    bool listen = true;              ///< somebody listens to the edges
    std::uint64_t slices = 0;        ///< seed of random cuts of the run between ops; 0: none
    std::size_t snapshot_at = 0;     ///< after this op the chip is saved, disturbed and restored; 0: never
};

/// By tick, then axis.
void sort_pulses(std::vector<Pulse>& pulses);

Outcome run_on_twin(const Program& program);

/// The first difference in words, or "" if there is none. Pulses are compared if both listened.
std::string difference(const Program& program, const Outcome& twin, const Outcome& chip, bool pulses);

}  // namespace motionrack::mcx314::twin
