// Register contents of a card, read through its port with the same accesses for a virtual and a real card.
#pragma once

#include <cstdint>
#include <motionrack/base/card_map.hpp>
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

/// Formats the view for a terminal; fields with value 0 are left out unless `all`.
std::string view_text(const RegisterView& view, bool all);
std::string view_json(const RegisterView& view);

}  // namespace motionrack::rack
