// Changing the tree of a TOML text and writing it again: one line a value, so that an error's line tells which value it
// is about.
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

/// The keys of a dotted name; those with dots stand in double quotes: axis.X.max_limit_mm, wires."motion.xin1". Empty:
/// it is no such name.
std::vector<std::string> toml_path(std::string_view text);
/// The dotted name of these keys, with quotes where TOML needs them.
std::string toml_name(std::span<const std::string> path);

/// Puts `value` at `path`, over what is there, with the tables that it needs on the way. False: something on the way is
/// no table, or a table is there; nothing was changed.
bool put_value(TomlNode& root, std::span<const std::string> path, const TomlNode& value);

/// A value of the tree with its name; an empty table is one, too.
struct TomlLine {
    std::string name;  ///< as toml_name writes it
    std::string value;
};
/// All values, in the order of the tree.
std::vector<TomlLine> toml_lines(const TomlNode& root);
/// The lines as a text that parse_toml reads to the same tree, places apart.
std::string toml_of(std::span<const TomlLine> lines);

}  // namespace motionrack::rack
