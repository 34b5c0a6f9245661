// The listeners to the positions of a chip's axes.
#pragma once

#include <array>
#include <motionrack/cards/mcx314/chip/state.hpp>
#include <motionrack/sim/listeners.hpp>

namespace motionrack::mcx314 {

struct PulseListeners {
    std::array<sim::Listeners, axes_of_chip> of_axis;
    unsigned heard = 0;  ///< axes, one bit each, whose position or edges have listeners

    /// Adds a listener to the position of axis `a`; returns its slot.
    int add(int a, sim::PositionListener& listener) {
        heard |= 1u << a;
        return of_axis[a].add(listener);
    }
};

}  // namespace motionrack::mcx314
