// The limit switches and the home switch of one axis, with their wires.
#pragma once

#include <array>
#include <motionrack/sim/kernel.hpp>
#include <motionrack/sim/parts/limit_switch.hpp>
#include <string>
#include <string_view>

namespace motionrack::parts {

class AxisSwitches {
  public:
    static constexpr int count = 3;
    using States = std::array<LimitSwitchState, count>;

    /// Adds the wires NAME.limit_minus, NAME.limit_plus, NAME.home of existing switches to the kernel.
    AxisSwitches(sim::Kernel& kernel, const std::string& name, const std::array<LimitSwitchSettings, count>& settings,
                 const Transmission& axle, States& states);

    const LimitSwitch& limit_minus() const { return switches_[0]; }
    const LimitSwitch& limit_plus() const { return switches_[1]; }
    const LimitSwitch& home() const { return switches_[2]; }
    /// Wires in this order; WireId::none if the switch is absent.
    sim::WireId wire(std::size_t i) const { return wires_[i]; }

    /// Moves the switches to the rotor's position.
    void check(std::int64_t rotor, Instant now);
    /// Calls `add` with the rotor range within which each switch does not change.
    template <class Add>
    void add_ranges(Add add) const {
        for (const LimitSwitch& s : switches_) add(axle_.rotor_range(s.range()));
    }
    /// The next edge of a bounce.
    Instant next() const;
    /// Makes the edges due until `now`.
    void act(Instant now);

    /// Sets or clears a fault of the switch `part`: stuck_open, stuck_closed. Returns false if it has none of the name.
    bool fault(std::string_view part, std::string_view name, double value);

  private:
    void show(std::size_t i) { kernel_.set_wire(wires_[i], switches_[i].level()); }

    sim::Kernel& kernel_;
    const Transmission& axle_;
    States& states_;
    std::array<LimitSwitch, count> switches_;
    std::array<sim::WireId, count> wires_{sim::WireId::none, sim::WireId::none, sim::WireId::none};
};

}  // namespace motionrack::parts
