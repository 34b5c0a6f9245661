// Wires, changes and faults of the switches.
#include <algorithm>
#include <motionrack/sim/parts/axis_switches.hpp>

namespace motionrack::parts {

namespace {

constexpr std::array<std::string_view, AxisSwitches::count> switch_names = {"limit_minus", "limit_plus", "home"};

}  // namespace

AxisSwitches::AxisSwitches(sim::Kernel& kernel, const std::string& name,
                           const std::array<LimitSwitchSettings, count>& settings, const Transmission& axle,
                           States& states)
    : kernel_(kernel),
      axle_(axle),
      states_(states),
      switches_{LimitSwitch(settings[0], axle, states[0]), LimitSwitch(settings[1], axle, states[1]),
                LimitSwitch(settings[2], axle, states[2])} {
    for (std::size_t i = 0; i < switches_.size(); ++i)
        if (switches_[i].present())
            wires_[i] = kernel_.add_wire(name + '.' + std::string(switch_names[i]), switches_[i].level());
}

void AxisSwitches::check(std::int64_t rotor, Instant now) {
    const std::int64_t table = axle_.table(rotor);
    for (std::size_t i = 0; i < switches_.size(); ++i) {
        if (!switches_[i].range().left(table)) continue;
        switches_[i].move(table, now);
        show(i);
    }
}

Instant AxisSwitches::next() const {
    Instant out = never;
    for (const LimitSwitch& s : switches_) out = std::min(out, s.next());
    return out;
}

void AxisSwitches::act(Instant now) {
    for (std::size_t i = 0; i < switches_.size(); ++i) {
        if (switches_[i].next() > now) continue;
        switches_[i].act(now);
        show(i);
    }
}

bool AxisSwitches::fault(std::string_view part, std::string_view name, double value) {
    const auto at =
        static_cast<std::size_t>(std::find(switch_names.begin(), switch_names.end(), part) - switch_names.begin());
    if (at == switch_names.size()) return false;
    const SwitchFault kind = name == "stuck_open"     ? SwitchFault::stuck_open
                             : name == "stuck_closed" ? SwitchFault::stuck_closed
                                                      : SwitchFault::none;
    if (kind == SwitchFault::none || !switches_[at].present()) return false;
    if (value == 0 && states_[at].fault != kind) return true;
    switches_[at].set_fault(value != 0 ? kind : SwitchFault::none);
    show(at);
    return true;
}

}  // namespace motionrack::parts
