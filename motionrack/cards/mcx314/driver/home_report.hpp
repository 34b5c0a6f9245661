// What a homing found: edges of the switch and the index with their places, how long each state took, and a sentence
// where it failed. All places are LP before home was declared; relative() counts them from home.
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
    near_limit,       ///< the switch was found, but the limit switch came before the axis stood
    not_released,     ///< the switch is active and stays so
    edges_differ,     ///< the switch acted where a sound one would not, by what was seen of it before
    no_index,         ///< the encoder's index was not seen
    index_at_switch,  ///< the index is active where the switch acts: the next start may find another turn
    wrong_index,      ///< an index was seen, but not where it is: there are two, or the switch was moved
    alarm,            ///< nALARM is enabled and active
    emergency,        ///< EMGN is Low
    time,             ///< a state lasted longer than it may
    foreign_stop,     ///< the drive ended for no reason that homing knows
    stopped           ///< stop(), or the user asked for it
};

/// The home input or the index changed.
struct ChipHomingEdge {
    std::string_view state;  ///< in which it was seen
    int input = 0;           ///< IN0..IN3
    bool active = false;     ///< what it became
    std::int32_t lp = 0;
    std::int32_t ep = 0;
    std::int64_t within =
        0;                ///< the edge was at `lp` or up to so many pulses before; 0: the chip stopped on it at once
    double speed_hz = 0;  ///< of the drive when it was seen
    Instant at{};
};

/// One stay in a state.
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
    bool homed = false;    ///< the position is trusted
    std::string sentence;  ///< how it ended
    std::vector<ChipHomingEdge> edges;
    std::vector<ChipHomingStateVisit> stays;
    std::vector<std::string> notes;
    std::int64_t bounces = 0;               ///< changes of the home input that were no new edge
    std::optional<std::int32_t> switch_lp;  ///< where the home input became active, last
    std::int64_t switch_within = 0;         ///< as HomeEdge::within
    double switch_speed_hz = 0;
    std::optional<std::int32_t> index_lp;
    std::int32_t zero_lp = 0;  ///< LP, before it was written, where home is
    std::int32_t zero_ep = 0;
    std::int64_t home_position = 0;  ///< what LP was given there
    Instant from{};
    Duration took{};

    /// A place in this report counted from home as LP counts afterwards; it means something only if homed.
    std::int64_t relative(std::int32_t lp) const;
    /// Pulses from the switch's edge to the index.
    std::optional<std::int64_t> switch_to_index() const;
    /// What to return to a caller: ErrorKind::stopped or ErrorKind::machine with the sentence, nothing if homed.
    Result<void> result() const;
};

}  // namespace motionrack::mcx314
