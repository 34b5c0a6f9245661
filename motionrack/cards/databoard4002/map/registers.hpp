// The DataBoard 4002's ports and words, declared once. The host reads EVENT and writes ENABLE through ports.
//
//   port     0     1     2    3    4    5    7
//   OUT      OUT   CS    C1   C2   C3   C4            CS belongs to the bus: it selects a card
//   INP      INP   STAT                      RST      RST resets all cards
#pragma once

#include <motionrack/base/registers.hpp>

namespace motionrack::databoard4002::map {

inline constexpr FieldInfo stat_fields[] = {
    {"INT", 0x01, "an interrupt is asked for"},
    {"EVENT", 0x02, "an enabled event has happened; the EVENT word is latched until C4 is written"},
    {"ZERO", 0x04, "zero pulse input is active"},
    {"REF", 0x08, "reference input is active"},
    {"EMS", 0x10, "emergency stop input is active"},
    {"ESR", 0x20, "end stop 1 (right) is active"},
    {"ESL", 0x40, "end stop 2 (left) is active"},
    {"READY", 0x80, "the card takes an access to DATA, C2 or C4"},
};
inline constexpr FieldInfo enable_fields[] = {
    {"POSITION", 0x01, "the position is reached or passed"},
    {"ZERO", 0x02, "zero pulse; also zeroes the counter"},
    {"REF", 0x04, "reference; also zeroes the counter. With ZERO: both at once"},
    {"STOP", 0x20, "an end stop or the emergency stop became active"},
    {"ON_READY", 0x40, "interrupt while Ready"},
    {"ON_EVENT", 0x80, "interrupt while an event is pending"},
};
inline constexpr FieldInfo event_fields[] = {
    {"POSITION", 0x01, "the position was reached or passed"},
    {"ZERO", 0x02, "the zero pulse was seen"},
    {"REF", 0x04, "the reference was seen"},
    {"STOP", 0x20, "an end stop or the emergency stop became active"},
    {"WATCH_OUT", 0x80, "the card was reset; the command W clears it"},
};

inline constexpr std::string_view through_port = "as seen through DATA";

inline constexpr RegisterInfo registers[] = {
    {"OUT", 0, 8, Access::write, false, "", "DATA: the next argument byte, low byte first", {}},
    {"CS", 1, 8, Access::write, false, "", "card select: the card of this number listens and answers from now on", {}},
    {"C1", 2, 8, Access::write, false, "", "not used", {}},
    {"C2", 3, 8, Access::write, false, "", "command, an ASCII letter", {}},
    {"C3",
     4,
     8,
     Access::write,
     false,
     "",
     "hardware reset of this card, whatever is written; pulses the output RST",
     {}},
    {"C4", 5, 8, Access::write, false, "", "event enable; the EVENT word goes to DATA and is freed", enable_fields},
    {"INP", 0, 8, Access::read, false, "", "DATA: the next answer byte, or the EVENT word after C4", {}},
    {"STAT", 1, 8, Access::read, false, "", "status", stat_fields},
    {"RST", 7, 8, Access::read, false, "", "reset of the whole I/O side", {}},
    {"EVENT", 0, 8, Access::read, false, through_port, "the events that have happened, put into DATA by C4",
     event_fields},
};
static_assert(declared<registers_flaw(registers)>());

}  // namespace motionrack::databoard4002::map
