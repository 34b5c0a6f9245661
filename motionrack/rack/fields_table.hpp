// Keys of a section as a table of a reference page.
#pragma once

#include <motionrack/rack/toml_reader.hpp>

namespace motionrack::rack {

/// Returns key, unit, range, default and meaning in Markdown, one row per field. Defaults come from the objects; keys
/// of both units have both names.
std::string fields_table(std::span<const Field> fields, const void* linear, const void* rotary);

}  // namespace motionrack::rack
