// Ports for G-code senders: a TCP port on this computer, and a pseudo-terminal that looks like a controller on a serial
// line.
//
//   sender ──TCP──► 127.0.0.1:PORT ──grbl::Introduction─┐
//   sender ──serial──► LINK ─► pts ─────────────────────┴─► grbl::GrblSession ─► operate::Machine
//
// One sender writes to the TCP port; the others observe, but their ? and ! are executed. A writer that has not
// identified as a sender loses its place: after `silence` to the next sender that sends bytes, on its close to the
// sender that has waited longest. The new writer is greeted as after a reset. Each port is a separate Grbl on the same
// machine; the control lease decides which may move it. The port has neither pairing nor encryption and therefore
// serves programs on this computer only. A connection whose first bytes are not those of a sender is closed. The
// pseudo-terminal is accessible to its owner only.
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
    std::optional<std::uint16_t> port = {};  ///< on 127.0.0.1; 0: any free port
    std::string link = {};      ///< path of the pseudo-terminal: free, or a symbolic link; empty: no pseudo-terminal
    int axes = 3;               ///< reported axes, 3 or 4, see grbl::SessionSettings
    std::size_t observers = 8;  ///< maximum number of observers beside the writer
    std::size_t waiting =
        std::size_t{1} << 20;  ///< maximum number of buffered bytes for a slow client; beyond it the client is closed
    bool resets_stop_all = false;  ///< resets also stop motion of other clients; resets of observers are executed
    /// A writer that has not identified as a sender for this time loses its place to the next sender that sends bytes.
    std::chrono::milliseconds silence{10'000};
    /// Called when a sender changes a setting, with a sentence. On the motion thread; must not block.
    std::function<void(const std::string& sender, const std::string& text)> on_setting = {};
    /// Called with the address of a connection that was closed because it is not a sender. At most once a second; on
    /// the network thread.
    std::function<void(const std::string& address)> on_unknown_sender = {};
};

class GrblPorts {
  public:
    /// Opens the configured ports and serves them on a separate thread. Call before Machine::run; machine and lease
    /// must outlive the object. Errors: io if the port is in use, no pseudo-terminal is available, or the link path is
    /// occupied.
    static Result<std::unique_ptr<GrblPorts>> open(const GrblPortSettings& settings, operate::Machine& machine,
                                                   auth::ControlLease& lease);
    /// Closes all connections, removes the link and ends the thread. Does not affect the machine.
    ~GrblPorts();

    std::uint16_t port() const;
    /// Returns "tcp 127.0.0.1:4711", "pty", both separated by a comma, or "none". Any thread.
    std::string sender() const;

  private:
    class Inside;
    explicit GrblPorts(std::unique_ptr<Inside> inside);
    std::unique_ptr<Inside> inside_;
};

}  // namespace motionrack::server
