// Edits the tree of a TOML text and writes it back with one value per line, so that an error's line identifies the
// value.
//
//   [axis.X]              axis.X.card = "motion"
//   card = "motion"  ──►  axis.X.max_limit_mm = 300
//   max_limit_mm = 300
#pragma once

#include <motionrack/rack/toml_reader.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::rack {

/// Splits a dotted name into keys; keys with dots stand in double quotes: axis.X.max_limit_mm, wires."motion.xin1".
/// Returns an empty list for an invalid name.
std::vector<std::string> toml_path(std::string_view text);
/// Joins keys into a dotted name, with quotes where TOML needs them.
std::string toml_name(std::span<const std::string> path);

/// Sets or replaces `value` at `path` and creates missing tables. Returns false, without any change, if a parent is not
/// a table or `path` is a table.
bool put_value(TomlNode& root, std::span<const std::string> path, const TomlNode& value);

/// A value of the tree with its name; an empty table also counts as a value.
struct TomlLine {
    std::string name;  ///< as written by toml_name
    std::string value;
};
/// Returns all values, in the order of the tree.
std::vector<TomlLine> toml_lines(const TomlNode& root);
/// Writes the lines as a text that parse_toml reads into the same tree, except for locations.
std::string toml_of(std::span<const TomlLine> lines);

}  // namespace motionrack::rack
