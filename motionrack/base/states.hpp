// How a card's state machines are declared.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace motionrack {

struct StateInfo {
    std::string_view name;
    std::string_view meaning;
    bool final = false;  ///< may be without exit
};

struct TransitionInfo {
    std::string_view from;
    std::string_view to;
    std::string_view when;
};

/// The first state is the one after reset.
struct MachineInfo {
    std::string_view name;
    std::string_view meaning;
    std::span<const StateInfo> states;
    std::span<const TransitionInfo> transitions;
};

constexpr int state_index(const MachineInfo& machine, std::string_view name) {
    for (std::size_t i = 0; i < machine.states.size(); ++i)
        if (machine.states[i].name == name) return static_cast<int>(i);
    return -1;
}

/// Every transition joins known states, every state can be reached from the first one and left unless it is final, no name twice.
constexpr bool machine_is_sound(const MachineInfo& machine) {
    if (machine.states.empty() || machine.states.size() > 64) return false;
    std::uint64_t reached = 1;
    for (std::size_t round = 0; round < machine.states.size(); ++round)
        for (const TransitionInfo& t : machine.transitions) {
            const int from = state_index(machine, t.from), to = state_index(machine, t.to);
            if (from < 0 || to < 0) return false;
            if (reached >> from & 1) reached |= std::uint64_t{1} << to;
        }
    for (std::size_t i = 0; i < machine.states.size(); ++i) {
        if (!(reached >> i & 1) || state_index(machine, machine.states[i].name) != static_cast<int>(i)) return false;
        bool exit = machine.states[i].final;
        for (const TransitionInfo& t : machine.transitions) exit = exit || (t.from == machine.states[i].name && t.to != t.from);
        if (!exit) return false;
    }
    return true;
}

constexpr bool machines_are_sound(std::span<const MachineInfo> machines) {
    for (const MachineInfo& machine : machines)
        if (!machine_is_sound(machine)) return false;
    return true;
}

}  // namespace motionrack
