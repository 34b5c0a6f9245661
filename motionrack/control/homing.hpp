// Request and result of homing one axis, in mm (degrees) and seconds, the same for every card.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::control {

/// Ways to find the home position of an axis.
enum class HomingMethod : std::uint8_t {
    stop_at_switch = 1,      ///< fast: decelerates at the switch, home is the stop position
    twice_to_switch = 2,     ///< backs off the switch and approaches it again slowly: home is its edge
    index_after_switch = 3,  ///< decelerates at the switch, then moves to the next index pulse of the encoder
    twice_and_index = 4      ///< as twice_to_switch, then to the index pulse
};

struct HomingRequest {
    HomingMethod method = HomingMethod::twice_to_switch;
    bool towards_plus = false;   ///< direction of the search
    double search_velocity = 0;  ///< > 0, at most the velocity limit
    double latch_velocity = 0;   ///< for the second approach and the index search, > 0, at most the velocity step limit
    double home_offset = 0;      ///< position value assigned at home
    /// Switch hysteresis: distance back until release, mm or degrees. Edges further apart than it and contact bounce
    /// explain make the result invalid. Absent: edges are not compared.
    std::optional<double> hysteresis;
    double backoff = 0.1;       ///< back-off beyond the release of the switch, mm or degrees, >= 0
    double settle_s = 0.005;    ///< debounce: time for which contacts must be stable, 0 .. 10 s
    double travel = 0;          ///< longest search, mm or degrees; 0: 1.2 times the travel of the axis
    bool turn_at_limit = true;  ///< at a limit switch, search in the other direction
    int switch_input = 0;       ///< input of the card at which the home switch is connected
    bool switch_active_high = false;
    int index_input = 2;  ///< input of the card at which the encoder index is connected
    bool index_active_high = true;
    std::optional<double> index_after;  ///< expected distance from switch to index; any other index is rejected
};

/// Edge of the home switch or the index. Positions count as after homing, or as before it if homing failed.
struct HomingEdge {
    std::string what;   ///< "switch on", "switch off", "index"
    std::string state;  ///< homing state in which it was seen
    double position = 0;
    double within = 0;    ///< position uncertainty, backwards along the motion; 0: exact to the pulse
    double velocity = 0;  ///< velocity of the axis at the edge
    double seconds = 0;   ///< time since the start of homing, s
};

struct HomingStateVisit {
    std::string state;
    double from_s = 0;  ///< start of the state, s since the start of homing
    double took_s = 0;
    double from = 0;  ///< position at the start of the state
    double to = 0;
};

/// Current homing state of an axis.
struct AxisHomingState {
    char letter = 'X';
    std::string state;  ///< name of the state as the card calls it: "SLOW_WAIT"
};

struct HomingResult {
    HomingMethod method = HomingMethod::twice_to_switch;
    bool towards_plus = false;
    bool homed = false;    ///< the position is valid
    std::string sentence;  ///< the outcome as a sentence
    std::vector<HomingEdge> edges;
    std::vector<HomingStateVisit> stays;
    std::vector<std::string> notes;
    std::int64_t bounces = 0;  ///< contact bounces: changes of the home switch that were not counted as edges
    double position = 0;       ///< final position
    double moved_by = 0;       ///< position error of the counter: new value less the old one at the same position
    std::optional<double> switch_to_index;
    Instant from{};
    double took_s = 0;
};

}  // namespace motionrack::control
