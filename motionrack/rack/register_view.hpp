// What a card's registers show, read through its port: the same accesses for a virtual card and a real one.
#pragma once

#include <cstdint>
#include <motionrack/base/card_map.hpp>
#include <motionrack/base/port.hpp>
#include <string>
#include <vector>

namespace motionrack::rack {

/// A register as it was read. `axis`: "" or the axis it belongs to.
struct RegisterSnapshot {
    const RegisterInfo* reg = nullptr;
    std::string axis = {};
    std::uint16_t word = 0;
};

/// A counter or another value that takes a read command.
struct ValueSnapshot {
    std::string_view name;
    std::string axis;
    std::int64_t value = 0;
    std::string_view meaning;
};

struct RegisterView {
    std::vector<RegisterSnapshot> registers;
    std::vector<ValueSnapshot> values;
    /// False where every word is FFFFh, as in an empty slot.
    bool answered() const;
};

/// The MCX314: all RR registers, LP, EP, CV, CA of each axis. Writes WR0 only, with NOP (to choose the axis) and read
/// commands; these change no motion, but RR6, RR7 and the chosen axis: nobody else may use the card meanwhile.
/// `clearing`: RR3 too, which clears its flags and lets the interrupt line go.
RegisterView view_mcx314(RegisterPort& port, bool clearing);

/// For a terminal; fields that are 0 are left out unless `all`.
std::string view_text(const RegisterView& view, bool all);
std::string view_json(const RegisterView& view);

}  // namespace motionrack::rack
