// The function library on a virtual chip in its own kernel, with the pulses of every axis recorded.
#pragma once

#include <motionrack/cards/mcx314/chip/chip.hpp>
#include <motionrack/cards/mcx314/driver/driver.hpp>
#include <motionrack/cards/mcx314/test/chip_bench.hpp>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/virtual_port.hpp>

namespace motionrack::mcx314 {

class DriverRig {
  public:
    explicit DriverRig(bool listen = false, Duration access = nanoseconds(500))
        : chip(kernel, "c"), port(kernel, chip, chip.id(), chip.interrupt_wire(), access), driver(port, port) {
        if (listen)
            for (int i = 0; i < 4; ++i) chip.pulses(i).set_edge_listener(&edges[static_cast<std::size_t>(i)]);
        kernel.start();
        driver.initialise();
    }
    /// Changes a wire of the chip.
    void wire(const std::string& pin, int level) {
        kernel.force(kernel.find_wire("c." + pin), level);
        kernel.settle();
    }
    /// Returns the pulses of an axis since the start, independent of LP.
    std::int64_t count(int axis) { return chip.pulses(axis).count(kernel.now()); }
    void deliver_edges() {
        for (int i = 0; i < 4; ++i) chip.pulses(i).deliver_edges();
    }

    sim::Kernel kernel;
    Chip chip;
    sim::VirtualPort port;
    Driver driver;
    std::array<outside::EdgeLog, 4> edges;
};

}  // namespace motionrack::mcx314
