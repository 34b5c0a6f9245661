// Random commands of operators, senders and pages to a machine, its belt and its laser, and accesses to its cards.
#pragma once

#include <motionrack/operate/machine.hpp>
#include <optional>
#include <span>
#include <string>
#include <tests/invariants/invariants.hpp>
#include <tests/swarm/draws.hpp>

namespace motionrack::swarm {

struct DrawnOrder {
    const char* name;
    int weight;                                      ///< relative frequency
    std::optional<test::Invariants::Order> changes;  ///< effect that the invariants must know
    Result<void> (*give)(operate::Machine& machine, Draws& draws);
};

/// All commands.
std::span<const DrawnOrder> all_orders();
/// Draws a command by weight.
const DrawnOrder& draw_order(Draws& draws);

/// Injects or clears a fault, or toggles a switch; holds its name.
struct DrawnFault {
    std::string text;
    bool disturbs = false;  ///< pulses and true positions may differ until this is detected
};
DrawnFault draw_fault(operate::Machine& machine, Draws& draws);
/// Clears all faults.
void mend_all(operate::Machine& machine);

}  // namespace motionrack::swarm
