// What each card and part of a rack does at a stop, as a table: the latch carries it out, the tests measure it, and the
// page docs/explanations/safety.md has it.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/rack/stop_source.hpp>
#include <span>
#include <string>
#include <string_view>

namespace motionrack::rack {

class Rack;

/// IEC 60204-1: 0, the power goes at once; 1, it stops with its drives' power, which goes then; 2, the power stays.
enum class StopCategory : std::uint8_t { category_0, category_1, category_2 };

/// Who does it.
enum class StopBy : std::uint8_t {
    card,   ///< by itself, from its input
    drive,  ///< whoever drives the axes, along their path and with their acceleration
    latch   ///< `act`
};

struct StopReaction {
    std::string_view part;  ///< type of a card, or "belt", "stage", "spindle"
    std::uint32_t sources;  ///< bits of StopSource
    StopCategory category;
    StopBy by;
    std::string_view happens;
    Duration within;    ///< from the edge, or from the order, until it happens, or until its ramp begins
    bool ramp = false;  ///< from then on it takes its ramp
    void (*act)(Rack& rack, const StopReaction& reaction) = nullptr;

    constexpr bool is_to(StopSource source) const { return (sources & 1u << static_cast<unsigned>(source)) != 0; }
};

std::span<const StopReaction> stop_reactions();

/// A state of the machine in which a stop is tested.
struct StopState {
    std::string_view name;  ///< in the names of the tests
    std::string_view text;
};
std::span<const StopState> stop_states();

/// Lets a belt, a table or a stage go on that a stop has brought to rest; a stage with all others of its card. Errors:
/// refused while the stop latch is set; invalid_input, there is no such part.
Result<void> start_part(Rack& rack, std::string_view name);

/// The page docs/explanations/safety.md.
std::string safety_reference();

}  // namespace motionrack::rack
