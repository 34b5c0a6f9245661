// Conditions that the card and its bus report, and their messages.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::ioflex02 {

enum class CardCondition : std::uint16_t {
    illegal_transition = 1,  ///< a: axis, b: the sample's instant in ns; once until CLEAR_ERRORS
    image_refused = 2,       ///< a: CfgError, b: bytes received
    unknown_project = 3,     ///< a: its ident
    no_project = 4,          ///< a: the register's offset; once until a project runs
    no_register = 5,         ///< a: the offset, b: the word written, or -1 for a read
    address_conflict = 6,    ///< a: the base address; reported once, by the bus
    outputs_held = 7         ///< a: bits of outputs that a stop cleared, and that stay low; once a stop
};

/// Describes a condition in a sentence: "card c1: at 0.012 s ...". `card`: the card's name.
std::string describe(const sim::Condition& condition, std::string_view card);

}  // namespace motionrack::ioflex02
