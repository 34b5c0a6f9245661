// Declaration of a card's state machines.
#pragma once

#include <cstdint>
#include <motionrack/base/declaration.hpp>
#include <span>
#include <string_view>

namespace motionrack {

struct StateInfo {
    std::string_view name;
    std::string_view meaning;
    bool final = false;  ///< may have no exit
};

struct TransitionInfo {
    std::string_view from;
    std::string_view to;
    std::string_view when;
};

/// The first state is the one after reset; at most 64 states.
struct MachineInfo {
    std::string_view name;
    std::string_view meaning;
    std::span<const StateInfo> states;
    std::span<const TransitionInfo> transitions;
};

/// Index in the table, or -1 for an unknown name.
constexpr int state_index(const MachineInfo& machine, std::string_view name) {
    for (std::size_t i = 0; i < machine.states.size(); ++i)
        if (machine.states[i].name == name) return static_cast<int>(i);
    return -1;
}

/// States reachable from the first one, one bit each.
constexpr std::uint64_t reachable_states(const MachineInfo& machine) {
    std::uint64_t reached = 1;
    for (std::size_t round = 0; round < machine.states.size(); ++round)
        for (const TransitionInfo& t : machine.transitions)
            if (reached >> state_index(machine, t.from) & 1) reached |= std::uint64_t{1} << state_index(machine, t.to);
    return reached;
}

/// Checks that every transition connects known states, that every state is reachable from the first one and has an exit
/// unless it is final, and that names are unique.
constexpr DeclarationError machine_flaw(const MachineInfo& machine) {
    if (machine.states.empty() || machine.states.size() > 64) return {machine.name, ": there are not 1 to 64 states"};
    if (const DeclarationError flaw = names_flaw(machine.name, "state", machine.states); !flaw.empty()) return flaw;
    for (const TransitionInfo& t : machine.transitions) {
        if (state_index(machine, t.from) < 0)
            return {machine.name, ": a transition comes from ", t.from, ", which is not a state"};
        if (state_index(machine, t.to) < 0)
            return {machine.name, ": a transition goes to ", t.to, ", which is not a state"};
        if (t.when.empty()) return {machine.name, ": the transition from ", t.from, " to ", t.to, " does not say when"};
    }
    const std::uint64_t reached = reachable_states(machine);
    for (std::size_t i = 0; i < machine.states.size(); ++i) {
        const StateInfo& state = machine.states[i];
        if (!(reached >> i & 1)) return {machine.name, ": the state ", state.name, " is never reached"};
        bool exit = state.final;
        for (const TransitionInfo& t : machine.transitions) exit = exit || (t.from == state.name && t.to != t.from);
        if (!exit) return {machine.name, ": the state ", state.name, " has no exit and is not final"};
    }
    return {};
}

constexpr DeclarationError machines_flaw(std::span<const MachineInfo> machines) {
    if (const DeclarationError flaw = names_flaw("the state machines", "state machine", machines); !flaw.empty())
        return flaw;
    for (const MachineInfo& machine : machines)
        if (const DeclarationError flaw = machine_flaw(machine); !flaw.empty()) return flaw;
    return {};
}

}  // namespace motionrack
