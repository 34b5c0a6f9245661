// A card's map as text for a terminal, as Markdown for the reference, and as JSON for programs.
#pragma once

#include <motionrack/base/card_map.hpp>
#include <string>

namespace motionrack {

/// Describes a card's map in indented lines for a terminal.
std::string describe_text(const CardMap& map);
/// Writes a card's map as the page docs/reference/<card>.md.
std::string describe_markdown(const CardMap& map);
/// Writes a card's map as an object with name, title and the lists registers (with fields), commands, machines (with
/// states and transitions) and pins. Masks, offsets and codes are numbers; strings are escaped for JSON.
std::string describe_json(const CardMap& map);

}  // namespace motionrack
