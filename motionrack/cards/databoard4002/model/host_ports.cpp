// Taking and executing an access; STAT.
#include <motionrack/cards/databoard4002/model/host_ports.hpp>

namespace motionrack::databoard4002 {

HostPorts::HostPorts(HostPortsState& state, Duration byte_time, const ConditionReporter& conditions,
                     PassSchedule& passes, const Pins& pins, EventRegister& events, CommandCollector& commands)
    : state_(state),
      byte_time_(byte_time),
      conditions_(conditions),
      passes_(passes),
      pins_(pins),
      events_(events),
      commands_(commands) {}

bool HostPorts::access(Work kind, std::uint8_t port, std::uint8_t value, Instant now) {
    if (!state_.ready) {
        conditions_.report(CardCondition::access_lost, port, kind == Work::in_data ? -1 : value);
        return false;
    }
    state_.ready = 0;
    state_.access = kind;
    state_.access_value = value;
    state_.access_due = passes_.first_from(now + byte_time_);
    passes_.request_at(state_.access_due);
    update_interrupt();
    return true;
}

void HostPorts::work(Instant now) {
    if (state_.access_due > now) return;
    const Work kind = state_.access;
    state_.access = Work::none;
    state_.access_due = never;
    state_.ready = 1;
    if (kind == Work::in_data) commands_.next_answer();
    if (kind == Work::out_data) commands_.take_argument(state_.access_value);
    if (kind == Work::command) commands_.take_command(state_.access_value, now);
    if (kind == Work::enables) commands_.enable_events(state_.access_value);
}

void HostPorts::request_pass() {
    if (state_.access != Work::none) passes_.request_at(state_.access_due);
}

std::uint8_t HostPorts::value(std::uint8_t port) const {
    if (port == ports::DATA) return commands_.latch();
    return port == ports::STAT ? status() : 0xFF;
}

std::uint8_t HostPorts::status() const {
    unsigned out = pins_.inputs();
    if (state_.ready) out |= stat::READY;
    if (events_.pending()) out |= stat::EVENT;
    if (pins_.level(interrupt_pin) != 0) out |= stat::INT;
    return static_cast<std::uint8_t>(out);
}

}  // namespace motionrack::databoard4002
