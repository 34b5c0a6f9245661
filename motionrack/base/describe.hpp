// A card's map as text: for a terminal, as Markdown for the reference, as JSON for programs.
#pragma once

#include <motionrack/base/card_map.hpp>
#include <string>

namespace motionrack {

std::string describe_text(const CardMap& map);
std::string describe_markdown(const CardMap& map);
std::string describe_json(const CardMap& map);

}  // namespace motionrack
