// Opens the port of a real card in the width of its registers.
#pragma once

#include <memory>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/live/live_port.hpp>
#include <motionrack/live/port_spec.hpp>
#include <string_view>

namespace motionrack::live {

/// The port of a real card, and the interface that its registers have.
struct OpenCard {
    std::unique_ptr<LivePort> port;
    RegisterPort* registers = nullptr;  ///< nullptr: they are not words of 16 bits
    BytePort* bytes = nullptr;          ///< nullptr: they are not ports of 8 bits
};

/// Checks an address without opening it. Errors: as CardPort::check.
Result<void> check_card(const PortSpec& spec, const CardMap& map);
/// Errors: as CardPort::open and ByteCardPort::open.
Result<OpenCard> open_card(const PortSpec& spec, const CardMap& map);

/// Opens the card at an address in text form with the port of its registers' width: CardPort or ByteCardPort. Errors:
/// as read_port_spec() and Port::open.
template <class Port>
Result<std::unique_ptr<Port>> open_card_at(std::string_view place, const CardMap& map) {
    MOTIONRACK_TRY(const PortSpec spec, read_port_spec(place));
    return Port::open(spec, map);
}

}  // namespace motionrack::live
