// The ports towards the host: the handshake by Ready, the access that the firmware has not processed yet, STAT.
//
//   access while Ready ──► Ready drops ──byte time──► the pass from there on executes it ──► Ready
//
// HostPorts::HandshakeSteps in the .cpp file is the table of this handshake.
#pragma once

#include <cstdint>
#include <motionrack/cards/databoard4002/model/command_collector.hpp>
#include <motionrack/cards/databoard4002/model/condition_reporter.hpp>
#include <motionrack/cards/databoard4002/model/event_register.hpp>
#include <motionrack/cards/databoard4002/model/pass_schedule.hpp>
#include <motionrack/cards/databoard4002/model/pins.hpp>
#include <motionrack/cards/databoard4002/model/state.hpp>

namespace motionrack::databoard4002 {

class HostPorts {
  public:
    /// `state` is part of the card's state and must outlive this. `byte_time`: firmware time for an access.
    HostPorts(HostPortsState& state, Duration byte_time, const ConditionReporter& conditions, PassSchedule& passes,
              const Pins& pins, EventRegister& events, CommandCollector& commands);

    /// Takes an access to DATA, C2 or C4. Returns false if the card is not Ready, so the access is lost.
    bool access(Work kind, std::uint8_t port, std::uint8_t value, Instant now);
    /// Value of a port for INP.
    std::uint8_t value(std::uint8_t port) const;

    /// Executes the access if it is due.
    void work(Instant now);
    /// Requests the pass that executes the access.
    void request_pass();
    void update_interrupt() { events_.update_interrupt(state_.ready != 0); }

  private:
    struct HandshakeSteps;

    std::uint8_t status() const;
    HostState host_state() const { return state_.ready ? HostState::ready : HostState::busy; }

    HostPortsState& state_;
    Duration byte_time_;
    const ConditionReporter& conditions_;
    PassSchedule& passes_;
    const Pins& pins_;
    EventRegister& events_;
    CommandCollector& commands_;
};

}  // namespace motionrack::databoard4002
