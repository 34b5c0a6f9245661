// What a signal lamp shows.
#include <motionrack/sim/parts/signal_lamp.hpp>

namespace motionrack::parts {

SignalLamp::SignalLamp(sim::Kernel& kernel, const std::string& name, bool active_low)
    : kernel_(kernel),
      active_low_(active_low),
      id_(kernel.add(*this, sim::Phase::parts, name)),
      input_(kernel.add_wire(name + ".in", 0)) {}

bool SignalLamp::lit() const {
    return state_.burnt_out == 0 && (kernel_.level(input_) != 0) != active_low_;
}

bool SignalLamp::fault(std::string_view name, double value, Instant) {
    if (name != "burnt_out" || (value != 0 && value != 1)) return false;
    state_.burnt_out = value != 0 ? 1 : 0;
    return true;
}

}  // namespace motionrack::parts
