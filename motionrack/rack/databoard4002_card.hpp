// The DataBoard 4002 in a running rack; its description is in databoard4002_plugin.cpp.
#pragma once

#include <memory>
#include <motionrack/cards/databoard4002/model/card.hpp>
#include <motionrack/rack/rack.hpp>
#include <span>
#include <string_view>

namespace motionrack::rack {

/// See CardPlugin::make.
std::unique_ptr<Card> make_databoard4002(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                         std::span<const std::unique_ptr<Card>> before);

/// Returns nullptr if the rack has no such card or the card is of another type.
const databoard4002::Card* databoard4002_card_of(Rack& rack, std::string_view name);

}  // namespace motionrack::rack
