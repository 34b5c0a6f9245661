// What the cards and their bus report as conditions, and the sentences.
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::grating_bus {

enum class BusCondition : std::uint16_t {
    wrong_direction = 1,  ///< a: 1 host, 0 slave, b: bit 0 the clock's shifter drives, bit 1 the address'
    bad_frame = 2,        ///< a: sequence, b: bit 0 missed words, bit 1 alien addresses, bit 2 lines, bit 3 CRC or N
    missed_edges = 3,     ///< a: how many, b: sequence
    overrun = 4,          ///< a: sequence; once until CLEAR_ERRORS
    stale = 5,            ///< a: sequence of the frame published last, -1: none yet, b: its time, 0.1 ns
    conflict = 6,         ///< by the bus, once a line; a: Line, b: numbers of two drivers, high * 64 + low
    no_register = 7       ///< a: the offset, b: the word written, -1: it was a read
};

/// "card c1: at 0.012 s ...". `card`: its name.
std::string describe(const sim::Condition& condition, std::string_view card);
/// Of the bus' own: "bus: at 0.012 s ...".
class Bus;
std::string describe(const sim::Condition& condition, const Bus& bus);

}  // namespace motionrack::grating_bus
