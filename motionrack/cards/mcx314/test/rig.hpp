// Runs a register program on a chip and records everything that a host and a motor could observe.
#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <motionrack/cards/mcx314/test/program.hpp>
#include <vector>

namespace motionrack::mcx314::twin {

/// Number of output pins of an axis; the first two are the pulse pins.
inline constexpr int output_count = 11, pulse_pins = 2;

/// State right after an op; `value`: result of a read.
struct Sight {
    std::uint16_t value = 0;
    bool interrupt = false;
    std::array<std::int64_t, axis_count> count{};
    std::array<unsigned, axis_count> outputs{};  ///< levels of nPP, nPM, nOUT4..7, nOUT0..3, nDRIVE
    friend bool operator==(const Sight&, const Sight&) = default;
};

/// A change of the interrupt line, in half ticks.
struct Request {
    std::int64_t half_tick = 0;
    bool active = false;
    friend bool operator==(const Request&, const Request&) = default;
};

/// A notification that a watched range of an axis' count was left.
struct Crossing {
    std::int64_t tick = 0;
    int axis = 0;
    std::int64_t count = 0;
    friend bool operator==(const Crossing&, const Crossing&) = default;
};

/// A change of a followed output pin.
struct Change {
    std::int64_t half_tick = 0;
    int axis = 0;
    int pin = 0;  ///< nPP, nPM, nOUT4..7, nOUT0..3, nDRIVE
    bool level = false;
    friend bool operator==(const Change&, const Change&) = default;
};

/// Returns the half width of the watched range number `n` of an axis around its count.
constexpr std::int64_t reach(int axis, std::size_t n) {
    return 1 + static_cast<std::int64_t>((n * 29 + static_cast<std::size_t>(axis) * 7) % 61);
}

struct Outcome {
    std::vector<Sight> sights;  ///< one per op
    std::vector<Pulse> pulses;  ///< by tick, then axis; only with a listener
    std::vector<Request> requests;
    std::array<std::vector<Crossing>, axis_count> crossings;  ///< only with a watch
    std::vector<Change> changes;                              ///< by instant, axis, pin; only with a follower
    std::uint64_t conditions = 0;                             ///< reported since the start
};

/// Sorts by tick, then axis.
void sort_pulses(std::vector<Pulse>& pulses);

Outcome run_on_twin(const Program& program);
/// Sorts by instant, axis, pin; drops changes without duration.
void sort_changes(std::vector<Change>& changes);

// For messages.
void PrintTo(const Sight& sight, std::ostream* out);
void PrintTo(const Pulse& pulse, std::ostream* out);
void PrintTo(const Request& request, std::ostream* out);
void PrintTo(const Crossing& crossing, std::ostream* out);
void PrintTo(const Change& change, std::ostream* out);

}  // namespace motionrack::mcx314::twin
