// Grating-bus cards in a running rack, for observers of frames.
#pragma once

#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <motionrack/rack/rack.hpp>
#include <vector>

namespace motionrack::rack {

extern const CardPlugin grating_bus_plugin;
extern const CardPlugin grating_decoder_plugin;

/// Returns the rack's bus; nullptr if the rack has none.
grating_bus::Bus* grating_bus_of(Rack& rack);
/// Returns the motion card of that name; nullptr if unknown.
grating_bus::Card* grating_card_of(Rack& rack, std::string_view name);

}  // namespace motionrack::rack
