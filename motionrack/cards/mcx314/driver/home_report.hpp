// Report of a homing: edges of the switch and the index with their positions, the duration of each state, and a
// sentence on a failure. All positions are LP before home was set; relative() counts them from home.
#pragma once

#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::mcx314 {

enum class HomeFault : std::uint8_t {
    none,
    not_found,        ///< the switch was not found within the travel, or before the limit
    near_limit,       ///< the switch was found, but the limit switch acted before standstill
    not_released,     ///< the switch remains active
    edges_differ,     ///< the switch acted beyond the hysteresis and repeatability of its earlier edges
    no_index,         ///< the encoder's index was not found
    index_at_switch,  ///< the index is active at the switch edge: the next homing may find another revolution
    wrong_index,      ///< an index was found at a wrong position: there are two, or the switch was moved
    alarm,            ///< nALARM is enabled and active
    emergency,        ///< EMGN is Low
    time,             ///< a state exceeded its time limit
    foreign_stop,     ///< the drive ended for a reason unknown to homing
    stopped           ///< stop(), or the user requested it
};

/// A change of the home input or the index.
struct ChipHomingEdge {
    std::string_view state;  ///< state in which it was seen
    int input = 0;           ///< IN0..IN3
    bool active = false;     ///< new level
    std::int32_t lp = 0;
    std::int32_t ep = 0;
    std::int64_t within =
        0;  ///< the edge was at `lp` or up to this number of pulses before; 0: the chip stopped on it at once
    double speed_hz = 0;  ///< drive speed at that instant
    Instant at{};
};

/// One visit of a state.
struct ChipHomingStateVisit {
    std::string_view state;
    Instant from{};
    Duration took{};
    std::int32_t from_lp = 0;
    std::int32_t to_lp = 0;
};

struct HomeReport {
    int type = 0;
    int axis = 0;           ///< channel, 0 X .. 3 U
    bool negative = false;  ///< direction of the search
    int input = 0;
    HomeFault fault = HomeFault::none;
    bool homed = false;    ///< the position is valid
    std::string sentence;  ///< result as a sentence
    std::vector<ChipHomingEdge> edges;
    std::vector<ChipHomingStateVisit> stays;
    std::vector<std::string> notes;
    std::int64_t bounces = 0;               ///< changes of the home input that were not a new edge
    std::optional<std::int32_t> switch_lp;  ///< last position at which the home input became active
    std::int64_t switch_within = 0;         ///< uncertainty in pulses, as ChipHomingEdge::within
    double switch_speed_hz = 0;
    std::optional<std::int32_t> index_lp;
    std::int32_t zero_lp = 0;  ///< LP of home before LP was written
    std::int32_t zero_ep = 0;
    std::int64_t home_position = 0;  ///< value written to LP there
    Instant from{};
    Duration took{};

    /// Returns a position of this report relative to home, as LP counts afterwards; valid only if homed.
    std::int64_t relative(std::int32_t lp) const;
    /// Returns the pulses from the switch's edge to the index.
    std::optional<std::int64_t> switch_to_index() const;
    /// Returns the result for a caller: success if homed, else ErrorKind::stopped or ErrorKind::machine with the
    /// sentence.
    Result<void> result() const;
};

}  // namespace motionrack::mcx314
