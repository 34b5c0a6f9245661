// A rack paced by a clock, with all its clients; the members are in the order of their dependencies.
//   clock ──► pacer ──► machine ◄──── panel ◄──── server ◄── browsers, programs
//                         ▲ ▲           │ journal    │
//                         │ └── lease ──┴──── auth ──┘
//                         └──── Grbl ports ◄── senders
#pragma once

#include <functional>
#include <memory>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/auth/control_lease.hpp>
#include <motionrack/auth/rate_limit.hpp>
#include <motionrack/frontends/server/grbl_ports.hpp>
#include <motionrack/frontends/server/page.hpp>
#include <motionrack/frontends/server/server.hpp>
#include <motionrack/frontends/server/settings.hpp>
#include <motionrack/journal/journal.hpp>
#include <motionrack/live/clock.hpp>
#include <motionrack/operate/clock_pacer.hpp>
#include <motionrack/operate/machine.hpp>
#include <motionrack/panel/panel.hpp>
#include <motionrack/rack/config.hpp>
#include <optional>
#include <string>

namespace motionrack::server {

/// Settings of all parts. ServedRack sets those that connect parts: pacer, journal, user commands, audit, versions.
struct ServedSettings {
    operate::ClockMode clock = operate::ClockMode::real;
    double factor = 1;  ///< simulated seconds per second
    std::function<void()> meanwhile =
        {};  ///< called repeatedly on the motion thread while it waits for the clock; must not block
    journal::Journal* journal = nullptr;  ///< receives events, commands and their callers
    std::string version = {}, boot = {};  ///< sent in the server's greeting
    operate::MachineSettings machine = {};
    auth::AuthSettings door = {};
    panel::PanelSettings panel = {};
    std::optional<GrblPortSettings> grbl = {};
    ServerSettings server = {};
    Page page = {};
};

class ServedRack {
  public:
    /// Makes all parts and opens the ports; the machine is stationary until run(). Errors: those of the parts.
    static Result<std::unique_ptr<ServedRack>> open(const rack::RackConfig& config, ServedSettings settings);

    /// Runs the machine on the calling thread until machine().quit().
    void run() { machine_->run(); }
    /// Closes the ports; no client is served afterwards.
    void stop();

    operate::ClockPacer& pacer() { return pacer_; }
    auth::ControlLease& lease() { return lease_; }
    operate::Machine& machine() { return *machine_; }
    auth::Authenticator& door() { return *door_; }
    panel::Panel& panel() { return *panel_; }
    Server& server() { return *server_; }
    const GrblPorts* grbl() const { return grbl_.get(); }  ///< nullptr: not configured

  private:
    ServedRack() = default;
    Result<void> make(const rack::RackConfig& config, ServedSettings settings);
    void write_down(const AuditEntry& entry);

    live::MonotonicClock clock_;
    operate::ClockPacer pacer_{clock_, operate::ClockMode::real, 1};
    auth::ControlLease lease_;
    journal::Journal* journal_ = nullptr;
    auth::RateLimit settings_of_senders_{20, 1};  ///< limits journal entries; a sender needs no token
    std::unique_ptr<operate::Machine> machine_;
    std::unique_ptr<auth::Authenticator> door_;
    std::unique_ptr<panel::Panel> panel_;
    std::unique_ptr<Server> server_;
    std::unique_ptr<GrblPorts> grbl_;
};

}  // namespace motionrack::server
