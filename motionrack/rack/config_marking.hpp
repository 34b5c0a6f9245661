// What a rack file says of marking machines: belts, rotary tables, scan heads.
#pragma once

#include <motionrack/rack/optics_fields.hpp>
#include <motionrack/sim/parts/marking_station.hpp>
#include <motionrack/sim/parts/serial_position_source.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// Parts that a track carries past a light barrier, at equal distances; mm or degrees.
struct RackParts {
    double every = 100;  ///< from part to part
    double first = 0;    ///< travel at which the first part's edge is at the sensor
    double length = 10;  ///< of a part, less than `every`
};

/// What moves the part under a scan head: a belt (mm) or a rotary table (degrees); see parts::ConveyorSettings.
struct RackConveyor {
    std::string name;
    bool rotary = false;
    std::optional<std::string> card;          ///< of type rtc5: where its lines lead to unless [wires] says otherwise
    std::int64_t encoder = 0;                 ///< 0, 1: the card's encoder input
    double speed = 100;                       ///< mm/s or degrees/s
    double deceleration = 2000;               ///< mm/s2 or degrees/s2: how it brakes when it is stopped
    double direction_deg = 0;                 ///< of a belt
    double centre_x_mm = 0, centre_y_mm = 0;  ///< of a table
    double counts_per_unit = 1000;            ///< of its encoder, four a line; 0: it has none
    double slip = 0;
    double jitter_us = 0;                    ///< greatest delay of an edge
    std::vector<parts::SpeedPoint> profile;  ///< instead of the speed, if not empty
    std::optional<parts::SerialPositionSettings> sender;
    std::optional<RackParts> passing;  ///< parts before a sensor

    /// "mm" or "deg".
    std::string_view unit() const { return rotary ? "deg" : "mm"; }
    bool has_encoder() const { return counts_per_unit != 0; }
    parts::ConveyorSettings settings() const;
    /// mm/s or degrees/s: quicker neither its encoder nor its sensor can be followed.
    double max_velocity() const;
};

/// What the encoder of a track can show, counts a second; what can pass a sensor, parts a second.
inline constexpr double max_track_counts = 1e7, max_parts = 1e5;

/// A scan head with its laser over a part; see parts::StationSettings.
struct RackScanner {
    std::string name;
    std::string card;                  ///< of type rtc5
    std::optional<std::string> track;  ///< what carries the part; absent: it lies still
    double bits_per_mm = 8656;         ///< without a lens
    double tolerance_um = 0.2;
    std::int64_t max_points = 200'000;
    std::optional<RackLens> lens;
    parts::GalvoSettings galvo;
    parts::LaserSettings laser;

    /// Without the track.
    parts::StationSettings settings() const;
};

}  // namespace motionrack::rack
