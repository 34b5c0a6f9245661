// A card with a host and manually driven wires.
#pragma once

#include <cstdint>
#include <motionrack/cards/io8255/model/card.hpp>
#include <motionrack/sim/virtual_port.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace motionrack::io8255 {

struct Rig {
    explicit Rig(Duration access = Duration{0})
        : card(kernel, "c1"), port(kernel, card, card.id(), card.interrupt_wire(), access) {}
    void start() { kernel.start(); }
    void set(const std::string& pin, int level) {
        kernel.set_wire(kernel.find_wire("c1." + pin), level);
        kernel.settle();
    }
    /// Sets the receivers of a port; `letter`: "a".
    void set_port(const std::string& letter, unsigned value) {
        for (unsigned i = 0; i < 8; ++i)
            set("p" + letter + std::to_string(i) + "_in", static_cast<int>(value >> i & 1));
    }
    int level(const std::string& pin) { return kernel.level(kernel.find_wire("c1." + pin)); }
    /// Levels of the drivers of a port.
    unsigned driven(const std::string& letter) {
        // The drivers are the first wires of the card, port by port.
        const auto first = sim::Kernel::index(first_wire) + std::size_t{8} * static_cast<std::size_t>(letter[0] - 'a');
        unsigned out = 0;
        for (std::size_t i = 0; i < 8; ++i)
            out |= static_cast<unsigned>(kernel.level(static_cast<sim::WireId>(first + i))) << i;
        return out;
    }
    /// Drives a receiver low and then high again.
    void pulse(const std::string& pin) {
        set(pin, 0);
        set(pin, 1);
    }
    void set_modes(const PortModes& modes) { port.out(offset("MODE_SET"), word_of(modes)); }
    void bit(unsigned line, unsigned level) { port.out(offset("BIT"), static_cast<std::uint8_t>(line << 1 | level)); }
    std::vector<CardCondition> conditions() {
        std::vector<CardCondition> out;
        for (const sim::Condition& c : kernel.conditions()) out.push_back(static_cast<CardCondition>(c.code));
        return out;
    }
    /// The sentence of the last condition.
    std::string sentence() {
        const auto all = kernel.conditions();
        return all.empty() ? std::string() : describe(all.back(), "c1");
    }

    sim::Kernel kernel;
    Card card;
    sim::VirtualBytePort port;
    sim::WireId first_wire = kernel.find_wire("c1.pa0");
};

/// Modes with all ports as outputs in mode 0.
inline constexpr PortModes all_outputs = {.a_strobed = false,
                                          .a_input = false,
                                          .c_upper_input = false,
                                          .b_strobed = false,
                                          .b_input = false,
                                          .c_lower_input = false};

}  // namespace motionrack::io8255
