// Bus reads.
#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

std::uint16_t Chip::read(std::uint32_t offset) {
    const Instant now = kernel_.now();
    catch_up(now);
    const std::uint16_t value = peek(offset);
    if (offset == reg::RR3) clear_flags(0xFFFF);
    settle(now);
    return value;
}

std::uint8_t Chip::read_byte(std::uint32_t port) {
    const Instant now = kernel_.now();
    catch_up(now);
    const bool high = (port & 1u) != 0;
    const unsigned value = peek(port & ~1u);
    if ((port & ~1u) == reg::RR3) clear_flags(high ? 0xFF00 : 0x00FF);
    settle(now);
    return static_cast<std::uint8_t>(high ? value >> 8 : value);
}

/// Handles a read of the bits in `mask` of RR3.
void Chip::clear_flags(std::uint16_t mask) {
    Axis& read_axis = state_.axis[state_.first_selected()];
    read_axis.flags = static_cast<std::uint16_t>(read_axis.flags & ~mask);
    requests_.forget_specials();
}

}  // namespace motionrack::mcx314
