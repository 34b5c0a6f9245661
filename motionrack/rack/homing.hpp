// Homes the axes of a running rack: sequence from the rack file, result of each axis, and the true machine position.
//
//   rack file ──► HomingRequest of each axis ──► control::Axis of its card, equal order numbers together ──► HomedAxis
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <motionrack/control/axis.hpp>
#include <motionrack/rack/rack.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::rack {

/// Builds the homing request of an axis from the rack file. Errors: refused if the home switch is missing or not wired
/// to a stop input of the axis' own channel; the same for the index, where the method needs it.
Result<control::HomingRequest> home_order(const RackConfig& config, const RackAxis& axis);

struct HomingProgress {
    double seconds = 0;  ///< virtual time since the start of homing
    int homed = 0;
    int axes = 0;
    std::vector<control::AxisHomingState> states;  ///< states of the axes that home together
};

/// Distance of each axis' index from its switch, as found by the first homing.
using SeenIndexes = std::array<std::optional<double>, control::axis_count>;

struct HomingSettings {
    std::string axes;                         ///< letters; "": every axis with a home switch
    std::optional<int> method;                ///< 1 .. 4 for all axes, instead of the rack file's method
    Duration timeout = whole_seconds(3600);   ///< timeout of each group
    const std::atomic<bool>* stop = nullptr;  ///< stop request (Ctrl-C)
    SeenIndexes* seen_indexes = nullptr;      ///< updated; used where the rack file has no index_after
    std::function<void(const HomingProgress&)> progress = {};  ///< every 50 ms of virtual time
    /// Called when an axis is homed, while others may still search. Its position counts from the last edge found, at
    /// `since`.
    std::function<void(char letter, Instant since)> on_homed = {};
};

/// Samples of an axis, every `sample_period` at first; the period doubles whenever the limit is reached.
struct HomingSamples {
    std::vector<double> seconds;  ///< since the start of homing
    std::vector<float> position;  ///< true position, mm or degrees
    std::vector<float> velocity;  ///< true velocity, per second
};

struct HomedAxis {
    char letter = 'X';
    std::string unit;
    control::HomingRequest order;
    bool begun = false;
    control::HomingResult outcome;  ///< valid if `begun`
    double began_s = 0;             ///< seconds from the start of the whole homing
    double counter_position = 0;    ///< position by the card's counter
    double measured_position = 0;   ///< position by the encoder; 0 without one
    double machine_position = 0;    ///< true position (simulated machines only)
    std::int64_t lost_pulses = 0;
    HomingSamples samples;
};

struct HomingOutcome {
    Result<void> ended;  ///< error of the first axis that failed; refused: nothing moved
    std::vector<HomedAxis> axes;
    double seconds = 0;
    bool all_homed() const;
};

/// Homes axes of a started rack. Leaves them at standstill; the positions of the homed axes are valid.
HomingOutcome home_axes(Rack& rack, const HomingSettings& settings);

/// Returns "X SLOW_WAIT, Y HOMED".
std::string homing_states_text(const std::vector<control::AxisHomingState>& states);
/// Formats the results as a table for a terminal; reproducible.
std::string homing_text(const HomingOutcome& outcome);
std::string homing_json(const HomingOutcome& outcome);
/// Draws position and velocity over time, with the states' names below, as SVG text.
std::string homing_picture(const HomedAxis& axis);

}  // namespace motionrack::rack
