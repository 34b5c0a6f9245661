// Conditions that the card reports, and their messages.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::io8255 {

enum class CardCondition : std::uint16_t {
    no_register = 1,       ///< a: the offset, b: the byte written, or -1 for a read
    both_directions = 2,   ///< a: a control word that asks for mode 2
    byte_lost = 3,         ///< a: 0 port A, 1 port B; a strobe while the buffer was full; once until a read
    byte_overwritten = 4,  ///< a: 0 port A, 1 port B; a write while the buffer was full; once until ACK
    flag_written = 5,      ///< a: line of port C that a handshake drives
    outputs_held = 6,      ///< a: port, b: bits of outputs that a stop cleared, and that stay low; once a stop
    byte_discarded = 7,    ///< a: 0 port A, 1 port B; a stop while the peripheral had not taken the byte
    byte_refused = 8       ///< a: 0 port A, 1 port B, b: bits of the strobed byte that a stop still holds low
};

/// Describes a condition in a sentence: "card c1: at 0.012 s ...". `card`: the card's name.
std::string describe(const sim::Condition& condition, std::string_view card);

}  // namespace motionrack::io8255
