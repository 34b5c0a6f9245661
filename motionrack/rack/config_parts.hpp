// Shared parts of the rack file reader: tables of keys, and the steps of reading.
#pragma once

#include <array>
#include <functional>
#include <motionrack/rack/card_types.hpp>
#include <motionrack/rack/config.hpp>
#include <motionrack/rack/toml_reader.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

// ---- Tables: one row per key

std::span<const Field> rack_fields();         ///< [rack] into RackConfig
std::span<const Field> card_fields();         ///< [card.NAME] into RackCard, without type-specific settings
std::span<const Field> axis_fields();         ///< [axis.X] into RackAxis
std::span<const Field> motor_fields();        ///< [axis.X.motor] into RackMotor
std::span<const Field> servo_fields();        ///< [axis.X.servo] into RackServo
std::span<const Field> switch_fields();       ///< [axis.X.switches] into RackSwitches
std::span<const Field> homing_fields();       ///< [axis.X.homing] into RackHoming
std::span<const Field> probe_fields();        ///< [probe] into RackProbe
std::span<const Field> stage_fields();        ///< [stage.NAME] into RackStage
std::span<const Field> scale_fields();        ///< [stage.NAME.scale] into RackScale
std::span<const Field> stage_servo_fields();  ///< [stage.NAME.servo] into RackStageServo
std::span<const Field> track_fields();        ///< [belt.NAME], [table.NAME] into RackConveyor
std::span<const Field> sender_fields();       ///< [belt.NAME.sender] into parts::SerialPositionSettings
std::span<const Field> passing_fields();      ///< [belt.NAME.parts] into RackParts
std::span<const Field> scanner_fields();      ///< [scanner.NAME] into RackScanner
std::span<const Field> controller_fields();   ///< [controller] into RackController
std::span<const Field> safety_fields();       ///< [safety] into RackSafety

inline constexpr std::array<std::string_view, 6> axis_names = {"X", "Y", "Z", "A", "B", "C"};
inline constexpr int slot_count = 21;

// ---- Steps of reading

/// Source of an axis in the file, and its rejected keys.
struct AxisSource {
    const TomlNode* table = nullptr;  ///< nullptr: the axis is not in the file (ideal axes of a card alone)
    std::vector<std::string_view> refused = {};

    bool sound(std::initializer_list<std::string_view> keys) const;
    /// Returns the location of the key, in the axis' own table or its table `sub` ("motor", "servo", "switches",
    /// "homing").
    TextPosition location(std::string_view key, std::string_view sub = {}) const;
};

/// Checks that involve several keys: axes against cards, positions against each other, velocities against chip and
/// motor. `sources` has one entry per axis of config.axes.
void check_axes(const RackConfig& config, const std::vector<AxisSource>& sources, Problems& problems);

/// Reads the section [probe] into config.probe and checks it against the axes and their cards.
void read_probe(const TomlNode& node, RackConfig& config, Problems& problems);

/// Reads the sections [stage.NAME] into config.stages and checks them against the cards.
void read_stages(const TomlNode& stages, RackConfig& config, Problems& problems);

/// Reads the sections [belt.NAME] and [table.NAME] into config.tracks and [scanner.NAME] into config.scanners. Each may
/// be nullptr. Checks them against the cards and each other.
void read_marking(const TomlNode* belts, const TomlNode* tables, const TomlNode* scanners, RackConfig& config,
                  Problems& problems);

/// Returns true for a valid name of wires, faults and reports: 1 to 32 letters, digits and '_', not beginning with a
/// digit.
bool is_name(std::string_view name);

/// Sets the wires of `config` and their links: the default rule, changed by the file's [wires] (may be nullptr).
void resolve_wires(RackConfig& config, const TomlNode* wires, Problems& problems);

/// Sets the links that follow from config.wires. `place_of` returns the location at which the file names an input, if
/// it does.
void resolve_links(RackConfig& config, const std::function<TextPosition(const std::string& input)>& location_of,
                   Problems& problems);

/// Returns the index of `axis`' channel in its card's type, or -1 if the card or the channel does not exist.
int channel_index(const RackConfig& config, const RackAxis& axis);

}  // namespace motionrack::rack
