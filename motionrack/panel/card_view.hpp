// Cards as JSON, from their maps: what they are, and what they show at this moment, by peek, so that looking disturbs
// nothing. A real card is read by its service alone.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <nlohmann/json.hpp>

namespace motionrack::panel {

/// What never changes: registers, fields, commands, states, pins, names of values. Of a card for which a real one
/// stands: where that is, and nothing that only the virtual one has.
nlohmann::json card_facts(operate::Machine& machine, const rack::Card& card);
/// Registers with their words, fields with their values, values, pins with their levels. On the motion thread, between
/// runs. Of a real card: as its service has read them last, or why there are none.
nlohmann::json card_now(operate::Machine& machine, rack::Card& card);
/// Of a databoard4002: its slope table as pictures of speed over distance. Errors: invalid_input, it is another card.
Result<nlohmann::json> slopes_now(rack::Rack& rack, const std::string& card);
/// What all cards of the grating bus hold, and whether they agree. Errors: refused, there is no such bus.
Result<nlohmann::json> frames_now(operate::Machine& machine);

}  // namespace motionrack::panel
