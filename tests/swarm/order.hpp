// What people, senders and pages order of a machine, drawn.
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
    int weight;                                      ///< so often among all
    std::optional<test::Invariants::Order> changes;  ///< what the laws must know of
    Result<void> (*give)(operate::Machine& machine, Draws& draws);
};

/// All that there are.
std::span<const DrawnOrder> all_orders();
/// By weight.
const DrawnOrder& draw_order(Draws& draws);

/// Breaks something, mends it, or throws a switch; its name.
struct DrawnFault {
    std::string text;
    bool disturbs = false;  ///< positions part from places by right, until that is noticed
};
DrawnFault draw_fault(operate::Machine& machine, Draws& draws);
/// All of them.
void mend_all(operate::Machine& machine);

}  // namespace motionrack::swarm
