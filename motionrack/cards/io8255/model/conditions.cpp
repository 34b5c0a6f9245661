// Messages for the card's conditions.
#include <fmt/format.h>

#include <motionrack/cards/io8255/model/conditions.hpp>

namespace motionrack::io8255 {

namespace {

char port_letter(std::int64_t port) {
    return static_cast<char>('A' + port);
}

std::string what_happened(const sim::Condition& c) {
    switch (static_cast<CardCondition>(c.code)) {
        case CardCondition::no_register:
            if (c.b < 0) return fmt::format("a read from {:02X}h, which has no register, returned FFh", c.a);
            return fmt::format("{:02X}h was written to {:02X}h, which has no register; nothing was changed", c.b, c.a);
        case CardCondition::both_directions:
            return fmt::format(
                "the control word {:02X}h asks for mode 2 of port A, which this card does not have; modes and outputs "
                "stay as they are. Use mode 0 or 1",
                c.a);
        case CardCondition::byte_lost:
            return fmt::format(
                "a strobe took a byte at port {} before the host had read the byte before, which is lost; the "
                "peripheral must wait until IBF is low",
                port_letter(c.a));
        case CardCondition::byte_overwritten:
            return fmt::format(
                "a byte was written to port {} before the peripheral had taken the byte before, which is lost; the "
                "host must wait until OBF is high",
                port_letter(c.a));
        case CardCondition::flag_written:
            return fmt::format(
                "line {} of port C was written, which the handshake of a strobed group drives; nothing was changed",
                c.a);
        case CardCondition::outputs_held:
            return fmt::format(
                "the outputs of port {} with the bits {:02X}h stayed low: a stop of the machine cleared them; write "
                "them low first, then high",
                port_letter(c.a), c.b);
        case CardCondition::byte_discarded:
            return fmt::format(
                "a stop of the machine discarded the byte at port {} that the peripheral had not taken; write it again "
                "if it is still needed",
                port_letter(c.a));
        case CardCondition::byte_refused:
            return fmt::format(
                "a byte at port {} was not put out: its bits {:02X}h stay low, since a stop of the machine cleared "
                "them; write them low first, then high",
                port_letter(c.a), c.b);
    }
    return fmt::format("condition {} ({}, {})", c.code, c.a, c.b);
}

}  // namespace

std::string describe(const sim::Condition& condition, std::string_view card) {
    return fmt::format("card {}: at {:.6f} s {}", card, to_seconds(condition.at), what_happened(condition));
}

}  // namespace motionrack::io8255
