// Messages for the card's conditions.
#include <fmt/format.h>

#include <motionrack/cards/ioflex02/map.hpp>
#include <motionrack/cards/ioflex02/model/conditions.hpp>

namespace motionrack::ioflex02 {

namespace {

const char* refusal(std::int64_t code) {
    switch (static_cast<CfgError>(code)) {
        case CfgError::foreign:
            return "it does not begin as an image of this card";
        case CfgError::length:
            return "its length is out of range";
        case CfgError::cut_short:
            return "it ended before its last byte";
        case CfgError::crc:
            return "its CRC-32 is wrong";
        default:
            return "it is valid";
    }
}

std::string what_happened(const sim::Condition& c) {
    switch (static_cast<CardCondition>(c.code)) {
        case CardCondition::illegal_transition:
            return fmt::format(
                "lines A and B of axis {} changed at once at {} ns; nothing was counted, so its position may be off. "
                "Further ones are only counted, until CLEAR_ERRORS",
                c.a, c.b);
        case CardCondition::image_refused:
            return fmt::format("the configuration image was refused after {} bytes: {}; the array is empty", c.b,
                               refusal(c.a));
        case CardCondition::unknown_project:
            return fmt::format(
                "the array has taken a project with the ident {:02X}h that this card does not know; only its ident can "
                "be read",
                c.a);
        case CardCondition::no_project:
            return fmt::format(
                "the register at {:02X}h was used while no project runs; it reads FFFFh and ignores writes", c.a);
        case CardCondition::no_register:
            if (c.b < 0) return fmt::format("a read from {:02X}h, which has no register, returned FFFFh", c.a);
            return fmt::format("{:04X}h was written to {:02X}h, which has no register; nothing was changed", c.b, c.a);
        case CardCondition::address_conflict:
            return fmt::format(
                "two cards answer at the base address {:04X}h: a read returns both words ANDed, a write goes "
                "to both. Give each card its own address",
                c.a);
        case CardCondition::outputs_held:
            return fmt::format(
                "the outputs with the bits {:04X}h stayed low: a stop of the machine cleared them; write them low "
                "first, then high",
                c.a);
    }
    return fmt::format("condition {} ({}, {})", c.code, c.a, c.b);
}

}  // namespace

std::string describe(const sim::Condition& condition, std::string_view card) {
    return fmt::format("card {}: at {:.6f} s {}", card, to_seconds(condition.at), what_happened(condition));
}

}  // namespace motionrack::ioflex02
