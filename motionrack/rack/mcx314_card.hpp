// The MCX314 in a running rack; its description is in mcx314_plugin.cpp.
#pragma once

#include <memory>
#include <motionrack/rack/catalogue.hpp>
#include <span>

namespace motionrack::rack {

/// See CardPlugin::make.
std::unique_ptr<Card> make_mcx314(sim::Kernel& kernel, const RackCard& config, sim::InputLog& log,
                                  std::span<const std::unique_ptr<Card>> before);

}  // namespace motionrack::rack
