// Conditions that the cards and their bus report, and their messages.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::grating_bus {

enum class BusCondition : std::uint16_t {
    wrong_direction = 1,  ///< a: 1 host, 0 slave; b: bit 0 the clock's shifter drives, bit 1 the address shifter drives
    bad_frame = 2,        ///< a: sequence, b: bits of BadFrame
    missed_edges = 3,     ///< a: number of edges, b: sequence
    overrun = 4,          ///< a: sequence; reported once until CLEAR_ERRORS
    stale = 5,            ///< a: sequence of the frame published last, -1: none yet, b: its time, 0.1 ns
    conflict = 6,         ///< by the bus, once per line; a: Line; b: driver of high * max_drivers + driver of low
    no_register = 7,      ///< a: the offset, b: the word written, or -1 for a read
    other_scale = 8       ///< a: the word, b: the address on the bus * 256 + that of the card's own list
};

/// Reasons for a bad frame, one bit each.
enum BadFrame : std::uint8_t {
    bad_missed = 1,  ///< read_n was high when a word was due
    bad_alien = 2,   ///< host: another address than expected; slave: an address that the frame already has
    bad_lines = 4,   ///< clk, hold or read_n had a wrong level
    bad_content = 8  ///< remote frame: wrong CRC or number of scales
};

/// Returns the message of a card's condition, as in "card c1: at 0.012 s ...". `card`: the card's name.
std::string describe(const sim::Condition& condition, std::string_view card);
class Bus;
/// Returns the message of a condition of the bus, as in "bus: at 0.012 s ...".
std::string describe(const sim::Condition& condition, const Bus& bus);

}  // namespace motionrack::grating_bus
