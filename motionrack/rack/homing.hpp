// Homing the axes of a running rack: order from the rack file, what each axis found, and where the machine really is.
//
//   rack file ──► HomeOrder of each axis ──► control::Axis of its card, those of one order number at once ──► HomedAxis
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

/// The order for an axis as its rack file has it. Errors: refused, it has no home switch, or that is not wired to a
/// stop input of its own channel; the same for the index, where the type needs it.
Result<control::HomingRequest> home_order(const RackConfig& config, const RackAxis& axis);

struct HomingProgress {
    double seconds = 0;  ///< virtual time since the homing began
    int homed = 0;
    int axes = 0;
    std::string states;  ///< "X SLOW_WAIT, Y HOMED"
};

/// How far behind its switch the index of each axis was when it was homed first.
using SeenIndexes = std::array<std::optional<double>, control::axis_count>;

struct HomingSettings {
    std::string axes;                         ///< letters; "": every axis that has a home switch
    std::optional<int> type;                  ///< 1 .. 4 for all of them, instead of the rack file's
    Duration timeout = whole_seconds(3600);   ///< of each group
    const std::atomic<bool>* stop = nullptr;  ///< Ctrl-C
    SeenIndexes* seen_indexes = nullptr;  ///< of searches before, which one whose place no key gives must agree with
    std::function<void(const HomingProgress&)> progress = {};  ///< every 50 ms of virtual time
    /// An axis is home, while others may still search; its place is that of the last edge that it found, at `since`.
    std::function<void(char letter, Instant since)> on_homed = {};
};

/// What was seen of an axis, every `sample_period` at first, each time twice that when there are too many.
struct HomingSamples {
    std::vector<double> seconds;  ///< since the homing began
    std::vector<float> position;  ///< of the machine, mm or degrees
    std::vector<float> speed;     ///< of the machine, per second
};

struct HomedAxis {
    char letter = 'X';
    std::string unit;
    control::HomingRequest order;
    bool begun = false;
    control::HomingResult outcome;  ///< where it was begun
    double began_s = 0;             ///< seconds from the start of the whole homing
    double counter_position = 0;    ///< where the card says the axis is
    double measured_position = 0;   ///< and the encoder, 0 without one
    double machine_position = 0;    ///< and where it is, which only a simulated machine can tell
    std::int64_t lost_pulses = 0;
    HomingSamples samples;
};

struct HomingOutcome {
    Result<void> ended;  ///< the first axis that failed; or refused, and then nothing moved
    std::vector<HomedAxis> axes;
    double seconds = 0;
    bool all_homed() const;
};

/// Homes axes of a rack that was started. Leaves them standing, those that succeeded with their positions trusted.
HomingOutcome home_axes(Rack& rack, const HomingSettings& settings);

/// A table of what was found, for a terminal: the same for the same homing.
std::string homing_text(const HomingOutcome& outcome);
std::string homing_json(const HomingOutcome& outcome);
/// Position and speed over time with the states' names below, as an SVG file's text.
std::string homing_picture(const HomedAxis& axis);

}  // namespace motionrack::rack
