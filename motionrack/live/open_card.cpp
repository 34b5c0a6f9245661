// The width of a card's registers.
#include <algorithm>
#include <motionrack/live/byte_card_port.hpp>
#include <motionrack/live/card_port.hpp>
#include <motionrack/live/open_card.hpp>

namespace motionrack::live {

namespace {

bool has_bytes(const CardMap& map) {
    return std::all_of(map.registers.begin(), map.registers.end(),
                       [](const RegisterInfo& reg) { return reg.width == 8; });
}

}  // namespace

Result<void> check_card(const PortSpec& spec, const CardMap& map) {
    return has_bytes(map) ? Result<void>() : CardPort::check(spec);
}

Result<OpenCard> open_card(const PortSpec& spec, const CardMap& map) {
    OpenCard out;
    if (has_bytes(map)) {
        MOTIONRACK_TRY(auto port, ByteCardPort::open(spec, map));
        out.bytes = port.get();
        out.port = std::move(port);
    } else {
        MOTIONRACK_TRY(auto port, CardPort::open(spec, map));
        out.registers = port.get();
        out.port = std::move(port);
    }
    return out;
}

}  // namespace motionrack::live
