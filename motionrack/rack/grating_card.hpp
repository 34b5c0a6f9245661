// The cards of a grating bus in a running rack, as those see them who look at frames.
#pragma once

#include <motionrack/cards/grating_bus/model/bus.hpp>
#include <motionrack/rack/rack.hpp>
#include <vector>

namespace motionrack::rack {

/// The rack's bus; nullptr if no card is on one.
grating_bus::Bus* grating_bus_of(Rack& rack);
/// The motion card of that name; nullptr if there is none.
grating_bus::Card* grating_card_of(Rack& rack, std::string_view name);

}  // namespace motionrack::rack
