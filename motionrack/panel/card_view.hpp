// Cards as JSON, from their maps: description and present state, by peek, so that reading has no side effects. A real
// card is read by its service only.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::panel {

/// Constant data: registers, fields, commands, states, pins, names of values. For a card replaced by a real one: the
/// address of the real card, and no data specific to the virtual one.
nlohmann::json card_facts(operate::Machine& machine, const rack::Card& card);
/// Registers with their words, fields with their values, values, pins with their levels. Call on the motion thread,
/// between runs. For a real card: as last read by its service, or the reason why nothing was read.
nlohmann::json card_now(operate::Machine& machine, rack::Card& card);
/// Slope table of a databoard4002 as diagrams of velocity over distance. Errors: invalid_input for another card.
Result<nlohmann::json> slopes_now(rack::Rack& rack, const std::string& card);
/// Frame contents of all grating-bus cards, and their agreement. Errors: refused if the rack has no such bus.
Result<nlohmann::json> frames_now(operate::Machine& machine);

}  // namespace motionrack::panel
