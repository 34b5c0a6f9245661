// Cards as JSON, from their maps: description and present state, by peek, so that reading has no side effects. A real
// card is read by its service only.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::panel {

/// Returns a card's constant data: registers, fields, commands, states, pins, names of values. For a card replaced by a
/// real one: the address of the real card, and no data specific to the virtual one.
nlohmann::json card_facts(operate::Machine& machine, const rack::Card& card);
/// Returns a card's present state: registers, fields, values and pins with their levels. Call on the motion thread,
/// between runs. For a real card: as last read by its service, or the reason why nothing was read.
nlohmann::json card_now(operate::Machine& machine, rack::Card& card);
/// Returns the slope table of a DataBoard 4002 as diagrams of pulse rate (Hz) over distance (counts). Errors:
/// invalid_input for another card.
Result<nlohmann::json> slopes_now(rack::Rack& rack, const std::string& card);
/// Returns the latest frames of all grating-bus cards, and whether they agree. Errors: refused if the rack has no such
/// bus.
Result<nlohmann::json> frames_now(operate::Machine& machine);

}  // namespace motionrack::panel
