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

// ---- Tables: one row per key; those of parts are in part_sections.hpp

std::span<const Field> rack_fields();        ///< [rack] into RackConfig
std::span<const Field> card_fields();        ///< [card.NAME] into RackCard, without type-specific settings
std::span<const Field> controller_fields();  ///< [controller] into RackController
std::span<const Field> safety_fields();      ///< [safety] into RackSafety

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

/// Reports a value that must be a table, by its path in the file; returns true for a table.
bool is_table(const TomlNode& node, const std::string& path, Problems& problems);

/// Returns true for a valid name of wires, faults and reports: 1 to 32 letters, digits and '_', not beginning with a
/// digit.
bool is_name(std::string_view name);

/// Sets the wires of `config` and their links: the default rule, changed by the file's [wires] (may be nullptr).
void resolve_wires(RackConfig& config, const TomlNode* wires, Problems& problems);

/// Sets the links that follow from config.wires. `location_of` returns the location at which the file names an input,
/// if it does.
void resolve_links(RackConfig& config, const std::function<TextPosition(const std::string& input)>& location_of,
                   Problems& problems);

/// Returns the index of `axis`' channel in its card's type, or -1 if the card or the channel does not exist.
int channel_index(const RackConfig& config, const RackAxis& axis);

}  // namespace motionrack::rack
