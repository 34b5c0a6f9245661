// Stop reactions of each card and part of a rack, as rows. The latch executes them, the tests measure them, and the
// page docs/explanations/safety.md shows them.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/rack/stop_source.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

class Rack;

/// IEC 60204-1: 0, power is removed immediately; 1, a controlled stop, then power is removed; 2, a controlled stop with
/// power kept.
enum class StopCategory : std::uint8_t { category_0, category_1, category_2 };

/// Component that executes the reaction.
enum class StopBy : std::uint8_t {
    card,   ///< the card itself, from its input
    drive,  ///< the driver of the axes, along their path and within their acceleration
    latch   ///< the latch, with `act`
};

/// Order in which reactions are executed and listed; those of one kind in the order of the catalogue of cards.
enum class StopOrder : std::uint8_t { axes, laser, conveyors, stages, analog_outputs, digital_outputs, spindle };

struct StopReaction {
    std::string_view part;  ///< card type, or "belt", "stage", "spindle"
    std::uint32_t sources;  ///< bits of StopSource
    StopCategory category;
    StopBy by;
    std::string_view happens;
    Duration within;    ///< maximum time from the edge or command to the reaction or the start of its ramp
    bool ramp = false;  ///< a ramp follows
    void (*act)(Rack& rack, const StopReaction& reaction) = nullptr;
    StopOrder order = StopOrder::axes;

    constexpr bool is_to(StopSource source) const { return (sources & 1u << static_cast<unsigned>(source)) != 0; }
};

/// Returns the bits of these sources.
constexpr std::uint32_t stop_bits(std::initializer_list<StopSource> sources) {
    std::uint32_t out = 0;
    for (const StopSource source : sources) out |= 1u << static_cast<unsigned>(source);
    return out;
}

/// Bits of the emergency stop, of all other sources, of all.
inline constexpr std::uint32_t only_emergency_stop = stop_bits({StopSource::emergency_stop});
inline constexpr std::uint32_t but_emergency_stop =
    stop_bits({StopSource::stop_command, StopSource::drive_alarm, StopSource::limit_switch, StopSource::watchdog,
               StopSource::following_error});
inline constexpr std::uint32_t every_stop = only_emergency_stop | but_emergency_stop;

/// One slice of the driver; an edge ends a slice immediately.
inline constexpr Duration stop_slice = milliseconds(50);

/// All reactions: those of the plug-ins of cards, and those of parts in stop_reactions.cpp.
std::vector<StopReaction> stop_reactions();
/// Executes the reactions of the latch itself to this source. Call between runs.
void react(Rack& rack, StopSource source);

/// A machine state in which a stop is tested.
struct StopState {
    std::string_view name;  ///< part of the test names
    std::string_view text;
};
std::span<const StopState> stop_states();

/// Restarts a belt, a table or a stage after a stop; a stage together with all others of its card. Errors: refused
/// while the stop latch is set; invalid_input for an unknown part.
Result<void> start_part(Rack& rack, std::string_view name);

/// Returns the text of docs/explanations/safety.md.
std::string safety_reference();

}  // namespace motionrack::rack
