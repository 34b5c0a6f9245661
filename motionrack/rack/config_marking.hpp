// Rack file settings of marking machines: belts, rotary tables, scan heads.
#pragma once

#include <motionrack/rack/optics_fields.hpp>
#include <motionrack/sim/parts/marking_station.hpp>
#include <motionrack/sim/parts/serial_position_source.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// Parts that a conveyor carries past a light barrier, at equal distances; mm or degrees.
struct RackParts {
    double part_pitch = 100;  ///< distance from a part's edge to the same edge of the next part
    double first_part = 0;    ///< travel at which the first part's edge is at the sensor
    double length = 10;       ///< length of a part, less than `part_pitch`
};

/// Conveyor under a scan head: a belt (mm) or a rotary table (degrees); see parts::ConveyorSettings.
struct RackConveyor {
    std::string name;
    bool rotary = false;
    std::optional<std::string> card;          ///< drives scan heads; default end of the conveyor's wires
    std::int64_t encoder = 0;                 ///< 0, 1: the card's encoder input
    double velocity = 100;                    ///< mm/s or degrees/s
    double deceleration = 2000;               ///< mm/s2 or degrees/s2, when the conveyor is stopped
    double direction_deg = 0;                 ///< direction of travel, from +X counter-clockwise (belts)
    double centre_x_mm = 0, centre_y_mm = 0;  ///< centre of rotation (tables)
    double counts_per_unit = 1000;            ///< encoder counts, four per line; 0: without encoder
    double slip = 0;
    double jitter_us = 0;                       ///< maximum delay of an edge
    std::vector<parts::VelocityPoint> profile;  ///< replaces the velocity if not empty
    std::optional<parts::SerialPositionSettings> sender;
    std::optional<RackParts> passing;  ///< parts that pass a sensor

    /// "mm" or "deg".
    std::string_view unit() const { return rotary ? "deg" : "mm"; }
    bool has_encoder() const { return counts_per_unit != 0; }
    parts::ConveyorSettings settings() const;
    /// Highest velocity that the encoder and the sensor can follow, mm/s or degrees/s.
    double max_velocity() const;
};

/// Limits of a conveyor: encoder counts per second; parts past a sensor per second.
inline constexpr double max_track_counts = 1e7, max_parts = 1e5;

/// A scan head with its laser over a part; see parts::StationSettings.
struct RackScanner {
    std::string name;
    std::string card;                     ///< name of a card that drives scan heads
    std::optional<std::string> conveyor;  ///< conveyor that carries the part; absent: a stationary part
    double bits_per_mm = 8656;            ///< scale without a lens
    double tolerance_um = 0.2;
    std::int64_t max_points = 200'000;
    std::optional<RackLens> lens;
    parts::GalvoSettings galvo;
    parts::LaserSettings laser;

    /// Returns the settings of the marking station, except its conveyor.
    parts::StationSettings settings() const;
};

}  // namespace motionrack::rack
