// An emergency stop button: a latching mushroom button, released by a turn. Its contact opens, as does a broken wire.
#pragma once

#include <motionrack/sim/kernel.hpp>
#include <string>
#include <string_view>

namespace motionrack::parts {

class EmergencyButton final : public sim::Device {
  public:
    /// Adds the device `name` and its wire of the same name (1: pressed, no current) to the kernel before it starts.
    EmergencyButton(sim::Kernel& kernel, const std::string& name)
        : kernel_(kernel), id_(kernel.add(*this, sim::Phase::parts, name)), wire_(kernel.add_wire(name, 0)) {}

    /// From outside, between runs; the wire changes at this instant.
    void press() { set(1, state_.broken); }
    void release() { set(0, state_.broken); }
    bool pressed() const { return state_.pressed != 0; }
    sim::WireId wire() const { return wire_; }

    void on_scheduled(Instant) override {}
    std::span<std::byte> state() override { return sim::bytes_of(state_); }
    /// Faults while not 0: pressed, broken (wire).
    bool fault(std::string_view name, double value, Instant) override {
        if (name == "pressed")
            set(value != 0, state_.broken);
        else if (name == "broken")
            set(state_.pressed, value != 0);
        else
            return false;
        return true;
    }

  private:
    struct State {
        std::int32_t pressed = 0;
        std::int32_t broken = 0;
    };
    void set(int pressed, int broken) {
        state_ = {pressed, broken};
        kernel_.set_wire(wire_, pressed != 0 || broken != 0);
    }

    sim::Kernel& kernel_;
    sim::DeviceId id_;
    sim::WireId wire_;
    State state_{};
};

}  // namespace motionrack::parts
