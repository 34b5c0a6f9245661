// The card's pins as wires of the kernel, and the broken wires of its inputs.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/cards/databoard4002/map.hpp>
#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::databoard4002 {

/// The pins of the map, in its order.
enum Pin : int {
    o1_pin,
    o2_pin,
    zero_pin,
    ref_pin,
    ems_pin,
    esr_pin,
    esl_pin,
    vout_pin,
    sign_pin,
    fout_pin,
    relay_pin,
    rst_pin,
    interrupt_pin,
    direct_pin,
    chosen_pin,  // driven by the bus
    pin_count
};

class Pins {
  public:
    /// Adds the wires "<name>.<pin>" to the kernel. `broken`: STAT bits of inputs whose wire is broken; part of the
    /// card's state.
    Pins(sim::Kernel& kernel, sim::DeviceId card, const std::string& name, std::uint8_t& broken);

    sim::WireId wire(int pin) const { return wires_[static_cast<std::size_t>(pin)]; }
    int level(int pin) const { return kernel_.level(wire(pin)); }
    void set(int pin, int level) { kernel_.set_wire(wire(pin), level); }
    void subscribe(int pin, bool wanted) { kernel_.subscribe(wire(pin), card_, wanted); }
    void force(int pin, int level) { kernel_.force(wire(pin), level); }
    void release(int pin) { kernel_.release(wire(pin)); }

    /// An opto-isolated input is active without current, so a broken wire reads as active.
    bool input(Pin pin, std::uint8_t stat_bit) const { return (broken_ & stat_bit) != 0 || level(pin) != 0; }
    /// STAT bits of the inputs.
    std::uint8_t inputs() const;

    /// Sets the interrupt line; a request ends the kernel's run.
    void set_interrupt(bool asked);

    /// Breaks or mends the wire that the fault names; returns false if it names none.
    bool break_wire(std::string_view fault, bool broken);

  private:
    sim::Kernel& kernel_;
    sim::DeviceId card_;
    std::array<sim::WireId, pin_count> wires_{};
    std::uint8_t& broken_;
};

}  // namespace motionrack::databoard4002
