// The grating bus' cards in a rack file: what the models need of the settings, and what does not fit between cards.
#pragma once

#include <motionrack/cards/grating_bus/model/settings.hpp>
#include <motionrack/rack/card_types.hpp>
#include <optional>
#include <span>
#include <vector>

namespace motionrack::rack {

/// Addresses of the scales that a card reads, in order; none if its list cannot be read (grating_bus_flaw says why).
std::vector<int> wanted_scales(const GratingBusSettings& card);

/// `first`: it is the first of its kind in the rack.
grating_bus::CardSettings grating_settings(const RackCard& card, bool first);
grating_bus::DecoderSettings decoder_settings(const RackCard& card);

std::optional<CardFlaw> grating_bus_flaw(const RackCard& card, std::span<const RackCard> before);
std::optional<CardFlaw> grating_decoder_flaw(const RackCard& card, std::span<const RackCard> before);
std::size_t grating_decoder_pin_count(const RackCard& card);

}  // namespace motionrack::rack
