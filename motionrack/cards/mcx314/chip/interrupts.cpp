// Drives the one interrupt line of the axes and the interpolator.
#include <motionrack/cards/mcx314/chip/interrupts.hpp>

namespace motionrack::mcx314 {

void Interrupts::update() {
    bool active = state_.path_interrupt || state_.pattern.interrupt;
    for (const Axis& axis : state_.axis) active = active || axis.flags != 0;
    if (active == state_.interrupt) return;
    state_.interrupt = active;
    kernel_.set_wire(wires_.interrupt, active ? 0 : 1);
    if (active) kernel_.break_run();
}

void Interrupts::clear(std::uint16_t mask) {
    Axis& read_axis = state_.axis[state_.first_selected()];
    read_axis.flags = static_cast<std::uint16_t>(read_axis.flags & ~mask);
    requests_.forget_specials();
}

}  // namespace motionrack::mcx314
