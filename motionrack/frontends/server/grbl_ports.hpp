// Where G-code senders connect: a TCP port of this computer, and a pseudo-terminal that looks like a controller on a
// serial line.
//
//   sender ──TCP──► 127.0.0.1:PORT ──grbl::Introduction─┐
//   sender ──serial──► LINK ─► pts ─────────────────────┴─► grbl::Session ─► operate::Machine
//
// One sender writes to the TCP port, others look on; their ? and ! are heard. Each of the two is a Grbl of its own on
// the same machine; which of them may move it is the control lease's matter. The port has neither pairing nor
// encryption, so it is there for programs of this computer only; of what connects to it nothing is heard that does not
// begin as a sender does. The pseudo-terminal is its owner's alone.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <motionrack/auth/control_lease.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/operate/machine.hpp>
#include <optional>
#include <string>

namespace motionrack::server {

struct GrblPortSettings {
    std::optional<std::uint16_t> port = {};  ///< on 127.0.0.1; 0: any free one
    std::string link = {};      ///< of the pseudo-terminal: a path that is free, or a symbolic link; empty: none
    int axes = 3;               ///< 3 or 4 that are reported, see grbl::SessionSettings
    std::size_t observers = 8;  ///< beside the one who writes
    std::size_t waiting = std::size_t{1} << 20;  ///< bytes for a client that does not read; with more it is let go
    bool resets_stop_all = false;  ///< also what others than the sender drive, and the resets of those who look on
    /// Who has the port, and says nothing for so long, loses it to the next who speaks.
    std::chrono::milliseconds silence{10'000};
    /// A sender changed a setting: a sentence. On the motion thread; must not wait.
    std::function<void(const std::string& sender, const std::string& text)> on_setting = {};
    /// A connection was closed, for it is no sender's: its address. Once a second at most; on the network thread.
    std::function<void(const std::string& address)> on_stranger = {};
};

class GrblPorts {
  public:
    /// Opens what the settings name and begins to serve on a thread of its own. Before Machine::run; machine and lease
    /// must outlive it. Errors: io, the port is taken, no pseudo-terminal, the link's path is something else.
    static Result<std::unique_ptr<GrblPorts>> open(const GrblPortSettings& settings, operate::Machine& machine,
                                                   auth::ControlLease& lease);
    /// Closes all connections, takes the link away and ends the thread. The machine is not touched.
    ~GrblPorts();

    std::uint16_t port() const;
    /// Any thread: "tcp 127.0.0.1:4711", "pty", both with a comma between, or "none".
    std::string sender() const;

  private:
    class Inside;
    explicit GrblPorts(std::unique_ptr<Inside> inside);
    std::unique_ptr<Inside> inside_;
};

}  // namespace motionrack::server
