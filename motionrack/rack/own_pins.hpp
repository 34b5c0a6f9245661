// Pins of a card's own map as rows of its plug-in.
#pragma once

#include <array>
#include <cstddef>
#include <motionrack/rack/card_types.hpp>

namespace motionrack::rack {

/// Converts a card's own list of pins. Pins whose names begin with "vout" are analog, 1 uV per level unit; the others
/// are digital.
template <std::size_t n>
constexpr std::array<PinType, n> own_pins(const PinInfo* pins) {
    std::array<PinType, n> out{};
    for (std::size_t i = 0; i < n; ++i)
        out[i] = {pins[i].name,    pins[i].direction,
                  pins[i].meaning, pins[i].name.substr(0, 4) == "vout" ? 1e-6 : 0,
                  PinKind::plain,  1,
                  pins[i].same_as};
    return out;
}

}  // namespace motionrack::rack
