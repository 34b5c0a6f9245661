// Register contents of a card, read through its port with the same accesses for a virtual and a real card.
#pragma once

#include <cstdint>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/port.hpp>
#include <motionrack/base/result.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

/// A register as read. `axis`: its axis, or "".
struct RegisterSnapshot {
    const RegisterInfo* reg = nullptr;
    std::string axis = {};
    std::uint16_t word = 0;
};

/// A counter or another value read with a command.
struct ValueSnapshot {
    std::string_view name;
    std::string axis;
    std::int64_t value = 0;
    std::string_view meaning;
};

struct RegisterView {
    std::vector<RegisterSnapshot> registers;
    std::vector<ValueSnapshot> values;
};

/// Reads an MCX314: all RR registers, and LP, EP, CV, CA of each axis. Writes WR0 only, with NOP (to select the axis)
/// and read commands. These change no motion, only RR6, RR7 and the selected axis; the card must not be used by others
/// meanwhile. `clearing`: also reads RR3, which clears its flags and releases the interrupt line.
RegisterView view_mcx314(RegisterPort& port, bool clearing);

/// Formats the view for a terminal; fields with value 0 are left out unless `all`.
std::string view_text(const RegisterView& view, bool all);
std::string view_json(const RegisterView& view);

}  // namespace motionrack::rack
