// A section's keys as a table of a reference page.
#pragma once

#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

/// Key, unit, range, default and meaning, a row for each field, in Markdown. Defaults are those of the objects; keys of
/// both units have both names.
std::string fields_table(std::span<const Field> fields, const void* linear, const void* rotary);

}  // namespace motionrack::rack
