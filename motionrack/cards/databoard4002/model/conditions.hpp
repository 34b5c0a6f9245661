// Conditions that the card reports, and their messages.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::databoard4002 {

enum class CardCondition : std::uint16_t {
    access_lost = 1,        ///< a: port, b: the byte written, or -1 for an INP
    unknown_command = 2,    ///< a: the byte
    arguments_dropped = 3,  ///< a: their command, b: number of bytes received
    data_unexpected = 4,    ///< a: the byte
    during_move = 5,        ///< a: the command
    move_refused = 6,       ///< a: the target, b: the position
    go_in_emergency = 7,    ///< a: the position
    move_aborted = 8,       ///< a: the position, b: the target
    table_flawed = 9,       ///< a: SlopeFlaw, b: the interval
    position_wrapped = 10,  ///< a: the counter
    rate_exceeded = 11,     ///< a: counts/s
    counts_lost = 12,       ///< a: number of counts, signed
    line_too_quick = 13,    ///< a: 1 or 2 (O1, O2)
    watchdog_reset = 14     ///< the firmware hung
};

/// Describes a condition in a sentence: "card c1: at 0.012 s ...". `card`: the card's name.
std::string describe(const sim::Condition& condition, std::string_view card);

}  // namespace motionrack::databoard4002
