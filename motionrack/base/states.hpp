// Declaration of a card's state machines, and the tables by which the code runs them.
//
//   map:    TransitionInfo {from, to, when}                 what documents, inspectors and pages show
//   model:  StateRow {from, on, to, guard, action}          what step() executes
//   static_assert(declared<rows_flaw(machine, rows)>());    both have the same ways from state to state
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/base/declaration.hpp>
#include <span>
#include <string_view>
#include <type_traits>

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

/// A state machine of a card; its first state is the one after reset. At most 64 states.
struct MachineInfo {
    std::string_view name;
    std::string_view meaning;
    std::span<const StateInfo> states;
    std::span<const TransitionInfo> transitions;
};

/// Returns the index of a state in the machine's list, or -1 for an unknown name.
constexpr int state_index(const MachineInfo& machine, std::string_view name) {
    for (std::size_t i = 0; i < machine.states.size(); ++i)
        if (machine.states[i].name == name) return static_cast<int>(i);
    return -1;
}

/// Returns the states reachable from the first one: bit i is set if state i is.
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

/// Returns the state machine of that name; an unknown name does not compile.
consteval const MachineInfo& machine_named(std::span<const MachineInfo> machines, std::string_view name) {
    for (const MachineInfo& each : machines)
        if (each.name == name) return each;
    throw "unknown state machine name";
}

// ---- tables that run

/// A row of a table that runs: in the state `from` the event `on` leads to `to` if the guard holds. The values of
/// `State` are the indices of the declared states; `Data` is what comes with an event.
template <class Owner, class State, class Event, class Data>
struct StateRow {
    State from;
    Event on;
    State to;
    bool (*guard)(const Owner&, Data) = nullptr;  ///< nullptr: always
    void (*action)(Owner&, Data) = nullptr;       ///< runs after the state was stored; nullptr: none
};

/// Executes the first row for the event in the state `from` whose guard holds: stores its state by `put`, then runs
/// its action. Returns false if no row fits: the event has no effect.
template <class Owner, class State, class Event, class Data, std::size_t count, class Put>
bool step(const StateRow<Owner, State, Event, Data> (&table)[count], State from, std::type_identity_t<Event> event,
          std::type_identity_t<Owner>& owner, std::type_identity_t<Data> data, const Put& put) {
    for (const StateRow<Owner, State, Event, Data>& row : table) {
        if (row.from != from || row.on != event || (row.guard != nullptr && !row.guard(owner, data))) continue;
        put(row.to);
        if (row.action != nullptr) row.action(owner, data);
        return true;
    }
    return false;
}

/// Executes the first row for the event in the state `state` whose guard holds, and stores the row's new state in
/// `state`. Returns false if no row fits.
template <class Owner, class State, class Event, class Data, std::size_t count>
bool step(const StateRow<Owner, State, Event, Data> (&table)[count], State& state, std::type_identity_t<Event> event,
          std::type_identity_t<Owner>& owner, std::type_identity_t<Data> data) {
    return step(table, State{state}, event, owner, data, [&state](State to) { state = to; });
}

/// Checks that the declared transitions are those that the code takes: taken(from, to), indices of different states.
template <class Taken>
constexpr DeclarationError transitions_flaw(const MachineInfo& machine, const Taken& taken) {
    const auto states = machine.states;
    for (std::size_t from = 0; from < states.size(); ++from)
        for (std::size_t to = 0; to < states.size(); ++to) {
            bool is_declared = false;
            for (const TransitionInfo& t : machine.transitions)
                is_declared = is_declared || (t.from == states[from].name && t.to == states[to].name);
            if (from == to || is_declared == taken(from, to)) continue;
            return {machine.name,
                    is_declared ? ": no row leads from " : ": a row, but no declared transition, leads from ",
                    states[from].name, " to ", states[to].name};
        }
    return {};
}

/// Checks that a table that runs has the declared states, and takes all declared transitions and no other.
template <class Owner, class State, class Event, class Data, std::size_t count>
constexpr DeclarationError rows_flaw(const MachineInfo& machine,
                                     const StateRow<Owner, State, Event, Data> (&table)[count]) {
    for (const StateRow<Owner, State, Event, Data>& row : table)
        if (static_cast<std::size_t>(row.from) >= machine.states.size() ||
            static_cast<std::size_t>(row.to) >= machine.states.size())
            return {machine.name, ": a row has a state that is not declared"};
    return transitions_flaw(machine, [&table](std::size_t from, std::size_t to) {
        for (const StateRow<Owner, State, Event, Data>& row : table)
            if (static_cast<std::size_t>(row.from) == from && static_cast<std::size_t>(row.to) == to) return true;
        return false;
    });
}

}  // namespace motionrack
