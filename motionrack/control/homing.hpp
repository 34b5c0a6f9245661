// What a program orders when it homes an axis, and what it learns: in mm (degrees) and seconds, whatever card does it.
#pragma once

#include <cstdint>
#include <motionrack/base/time.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::control {

/// Ways of finding home.
enum class HomingMethod : std::uint8_t {
    stop_at_switch = 1,      ///< quick: decelerates at the switch and stands where it stops
    twice_to_switch = 2,     ///< back off the switch and to it again slowly: stands on its edge
    index_after_switch = 3,  ///< decelerates at the switch, then to the encoder's next index
    twice_and_index = 4      ///< as twice_to_switch, then to the index
};

struct HomingRequest {
    HomingMethod type = HomingMethod::twice_to_switch;
    bool towards_plus = false;  ///< direction of the search
    double speed = 0;           ///< of the search, > 0, at most the axis' greatest
    double slow_speed = 0;      ///< of the second approach and of the way to the index, > 0, at most the start speed
    double position = 0;        ///< what the home place is called
    /// Way back until the switch is released: edges that this does not explain are not trusted. Absent: not compared.
    std::optional<double> hysteresis;
    double clearance = 0.1;     ///< mm or degrees driven on after the switch is released, >= 0
    double settle_s = 0.005;    ///< how long contacts must be at rest, 0 .. 10 s
    double travel = 0;          ///< longest search, mm or degrees; 0: a fifth more than the axis' travel
    bool turn_at_limit = true;  ///< at a limit switch, search the other way
    int switch_input = 0;       ///< the card's input of the home switch
    bool switch_active_high = false;
    int index_input = 2;  ///< the card's input of the encoder's index
    bool index_active_high = true;
    std::optional<double> index_after;  ///< how far behind the switch the index is; another one is not trusted
};

/// The home switch or the index changed. Places are positions as they count after homing; before that, where it failed.
struct HomingEdge {
    std::string what;   ///< "switch on", "switch off", "index"
    std::string state;  ///< in which it was seen
    double position = 0;
    double within = 0;   ///< it was there or up to so much earlier on the way; 0: exact to the pulse
    double speed = 0;    ///< of the axis there
    double seconds = 0;  ///< since the homing began
};

struct HomingStateVisit {
    std::string state;
    double from_s = 0;  ///< since the homing began
    double took_s = 0;
    double from = 0;  ///< positions
    double to = 0;
};

struct HomingResult {
    HomingMethod type = HomingMethod::twice_to_switch;
    bool towards_plus = false;
    bool homed = false;    ///< the position is trusted
    std::string sentence;  ///< how it ended
    std::vector<HomingEdge> edges;
    std::vector<HomingStateVisit> stays;
    std::vector<std::string> notes;
    std::int64_t bounces = 0;  ///< changes of the home switch that were no new edge
    double position = 0;       ///< where the axis stands
    double moved_by = 0;       ///< how much the counter was off: new position less the old one at the same place
    std::optional<double> switch_to_index;
    Instant from{};
    double took_s = 0;
};

}  // namespace motionrack::control
