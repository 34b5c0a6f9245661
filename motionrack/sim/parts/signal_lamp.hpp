// A signal lamp of a machine, driven by an output.
//
//   NAME.in   ____/~~~~~~~~\____       active low:   ~~~~\________/~~~~
//   lit           ##########                             ##########        burnt out: never
#pragma once

#include <cstdint>
#include <motionrack/sim/kernel.hpp>
#include <string>

namespace motionrack::parts {

class SignalLamp final : public sim::Device {
  public:
    /// Adds the device `name` and its input, the wire `name`.in (low at rest), to the kernel before it starts.
    SignalLamp(sim::Kernel& kernel, const std::string& name, bool active_low);

    sim::DeviceId id() const { return id_; }
    /// Returns true while it shines.
    bool lit() const;

    /// Does nothing: the lamp drives no wire, so it schedules no events.
    void on_scheduled(Instant) override {}
    /// Fault burnt_out, 0 or 1: it stays dark.
    bool fault(std::string_view name, double value, Instant now) override;
    std::span<std::byte> state() override { return sim::bytes_of(state_); }

  private:
    struct State {
        std::int32_t burnt_out = 0;
    };

    const sim::Kernel& kernel_;
    bool active_low_;
    sim::DeviceId id_{};
    sim::WireId input_{};
    State state_{};
};

}  // namespace motionrack::parts
