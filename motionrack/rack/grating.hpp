// Grating-bus cards in a rack file: settings for the models, and conflicts between cards.
#pragma once

#include <motionrack/cards/grating_bus/model/settings.hpp>
#include <motionrack/rack/card_types.hpp>
#include <optional>
#include <span>
#include <vector>

namespace motionrack::rack {

/// Returns the addresses of the scales that a card reads, in order; empty if its list is invalid (grating_bus_flaw
/// gives the reason).
std::vector<int> wanted_scales(const GratingBusSettings& card);

/// Converts a card of the rack file. `first`: it is the first card of its kind in the rack.
grating_bus::CardSettings grating_settings(const RackCard& card, bool first);
grating_bus::DecoderSettings decoder_settings(const RackCard& card);

std::optional<CardFlaw> grating_bus_flaw(const RackCard& card, std::span<const RackCard> before);
std::optional<CardFlaw> grating_decoder_flaw(const RackCard& card, std::span<const RackCard> before);
std::size_t grating_decoder_pin_count(const RackCard& card);

}  // namespace motionrack::rack
