// Taking and executing an access by the table of the handshake; STAT.
#include <motionrack/cards/databoard4002/model/host_ports.hpp>

namespace motionrack::databoard4002 {

struct HostPorts::HandshakeSteps {
    enum class Event : std::uint8_t { access, done };
    struct Access {
        Work kind = Work::none;
        std::uint8_t port = 0, value = 0;
        Instant now{};
    };

    static void take(HostPorts& ports, const Access& access) {
        HostPortsState& s = ports.state_;
        s.access = access.kind;
        s.access_value = access.value;
        s.access_due = ports.passes_.first_from(access.now + ports.byte_time_);
        ports.passes_.request_at(s.access_due);
        ports.update_interrupt();
    }
    static void lose(HostPorts& ports, const Access& access) {
        ports.conditions_.report(CardCondition::access_lost, access.port,
                                 access.kind == Work::in_data ? -1 : access.value);
    }
    static void execute(HostPorts& ports, const Access& access) {
        HostPortsState& s = ports.state_;
        const Work kind = s.access;
        s.access = Work::none;
        s.access_due = never;
        if (kind == Work::in_data) ports.commands_.next_answer();
        if (kind == Work::out_data) ports.commands_.take_argument(s.access_value);
        if (kind == Work::command) ports.commands_.take_command(s.access_value, access.now);
        if (kind == Work::enables) ports.commands_.enable_events(s.access_value);
    }

    static constexpr StateRow<HostPorts, HostState, Event, const Access&> rows[] = {
        {HostState::ready, Event::access, HostState::busy, nullptr, take},
        {HostState::busy, Event::access, HostState::busy, nullptr, lose},
        {HostState::busy, Event::done, HostState::ready, nullptr, execute},
    };
    static_assert(declared<rows_flaw(machine_named(map::machines, "host"), rows)>());

    static void run(HostPorts& ports, Event event, const Access& access) {
        step(rows, ports.host_state(), event, ports, access,
             [&ports](HostState to) { ports.state_.ready = to == HostState::ready; });
    }
};

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
    const bool taken = host_state() == HostState::ready;
    HandshakeSteps::run(*this, HandshakeSteps::Event::access, {kind, port, value, now});
    return taken;
}

void HostPorts::work(Instant now) {
    if (state_.access_due <= now) HandshakeSteps::run(*this, HandshakeSteps::Event::done, {.now = now});
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
