// Present state of each declared state machine (map.hpp), derived from the chip's working state.
#include <iterator>
#include <motionrack/cards/mcx314/chip/machine_states.hpp>
#include <motionrack/cards/mcx314/map.hpp>

namespace motionrack::mcx314 {

namespace {

/// Returns the index of a state in its machine's table; an unknown name does not compile.
consteval int place(std::string_view machine_name, std::string_view name) {
    const int index = state_index(machine_named(map::machines, machine_name), name);
    if (index < 0) throw "the state machine has no state of this name";
    return index;
}

/// Indices of the home search's states, in the order of map::home_drives.
constexpr int home_places[] = {place("home search", "near"),   place("home search", "home"),
                               place("home search", "escape"), place("home search", "again"),
                               place("home search", "index"),  place("home search", "offset")};
static_assert(std::size(home_places) == std::size(map::home_drives));

}  // namespace

int MachineStates::drive_state(int a) const {
    const Axis& axis = state_.axis[a];
    const Generator& gen = state_.axis[bit(state_.chain, a) ? state_.master : a].gen;
    if (gen.drive != Drive::idle) {
        if (tick_of(kernel_.now()) - gen.at < gen.wait) return place("drive", "starting");
        return gen.final ? place("drive", "final") : place("drive", "driving");
    }
    if (axis.held_command != 0) return place("drive", "held");
    return state_.waits_for_position(a) ? place("drive", "in_position") : place("drive", "idle");
}

int MachineStates::queue_state() const {
    if (state_.chain == 0) return place("continuous interpolation", "idle");
    return state_.queued ? place("continuous interpolation", "queued") : place("continuous interpolation", "running");
}

int MachineStates::pattern_state() const {
    if (state_.chain != 0 && state_.path.command.pattern() && state_.pattern.place < Pattern::length)
        return place("bit pattern", "running");
    return state_.pattern.place < Pattern::length ? place("bit pattern", "stopped") : place("bit pattern", "idle");
}

int MachineStates::stack_state() const {
    return state_.pattern.stacked;
}

int MachineStates::step_state() const {
    if (state_.chain == 0 || !state_.by_steps(state_.master)) return place("single steps", "free");
    return state_.steps.in_progress ? place("single steps", "stepping") : place("single steps", "waiting");
}

int MachineStates::wire_state(int a, int minus) const {
    static constexpr int by_low_ticks[] = {place("drive by wire", "high"), place("drive by wire", "falling"),
                                           place("drive by wire", "low")};
    const Axis& axis = state_.axis[a];
    return drives_by_wire(axis.wr3) ? by_low_ticks[axis.external_low[minus]] : place("drive by wire", "off");
}

int MachineStates::home_state(int a) const {
    for (int i = 0; i < static_cast<int>(std::size(map::home_drives)); ++i)
        if (map::home_drives[i].hmst == state_.extension[a].home.hmst) return home_places[i];
    return place("home search", "idle");
}

/// Returns the state "differs" if any filtered input of the axis differs from its wire, else "same".
int MachineStates::filter_state(int a) const {
    const Extension& ext = state_.extension[a];
    const bool differs = (ext.filtered & (ext.wires ^ state_.axis[a].levels)) != 0;
    return differs ? place("input filter", "differs") : place("input filter", "same");
}

int MachineStates::clear_state(int a) const {
    const bool pulse = tick_of(kernel_.now()) < state_.extension[a].clear_until;
    return pulse ? place("deviation counter clear", "pulse") : place("deviation counter clear", "rest");
}

int MachineStates::action_state(int a) const {
    return bit(state_.acting, a) ? place("synchronous action", "due") : place("synchronous action", "waiting");
}

}  // namespace motionrack::mcx314
