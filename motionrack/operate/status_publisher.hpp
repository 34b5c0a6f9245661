// Status of an operated machine, and its listeners.
//
//   commands, motion ──► state, reason, alarms, homing, tools: at once ──┐
//   axes, program, service ──publish: every slice────────────────────────┴──► Status ──► listeners, in their order
//   a commanded stop or reset ──report_stop: within the command──► stop listeners
#pragma once

#include <functional>
#include <motionrack/control/gcode/canon_call.hpp>
#include <motionrack/operate/status.hpp>
#include <motionrack/rack/rack.hpp>
#include <string>
#include <vector>

namespace motionrack::operate {

class AxisEnables;
class PositionValidity;
class ProgramRun;
class Service;

/// Used only by the motion thread.
class StatusPublisher {
  public:
    /// Read by publish(); they must outlive this.
    struct StatusSources {
        rack::Rack& rack;
        const PositionValidity& validity;
        const AxisEnables& enables;
        const ProgramRun& programs;
        const Service& service;
    };
    /// `first`: called before all listeners; may be empty.
    StatusPublisher(const StatusSources& sources, std::function<void(const Status&)> first);
    /// Adds listeners, as Machine::listen.
    void listen(std::function<void(const Status&)> call, std::function<void(const StopReport&)> on_stop);

    const Status& status() const { return status_; }
    Status& status() { return status_; }
    /// Present state; status().state is the one at the last publish().
    MachineState state() const { return state_; }
    void enter(MachineState state, std::string reason = {});
    /// Describes the running or pending action in a few words.
    std::string at_work() const;

    // ---- spindle and coolant
    /// Updates spindle and coolant from an event of a program.
    void pass_event(const control::gcode::CanonCall& event);
    void set_coolant(bool mist, bool flood);
    void tools_off();

    // ---- listeners
    /// Completes the status and calls the listeners.
    void publish();
    /// Reports a stop that has a source. The first of several gives the reason, since a page sends its STOP on two
    /// channels.
    void report_stop(const StopReport& report);

  private:
    StatusSources sources_;
    Status status_;
    MachineState state_ = MachineState::disabled;
    std::vector<std::function<void(const Status&)>> listeners_;
    std::vector<std::function<void(const StopReport&)>> stop_listeners_;
};

}  // namespace motionrack::operate
