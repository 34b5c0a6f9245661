// One of the two ports for senders, on the motion thread: its Grbl session, its writer and the control lease.
#pragma once

#include <functional>
#include <memory>
#include <motionrack/auth/control_lease.hpp>
#include <motionrack/frontends/server/grbl_connection.hpp>
#include <motionrack/frontends/server/grbl_ports.hpp>
#include <motionrack/grbl/grbl_session.hpp>
#include <motionrack/operate/machine.hpp>
#include <string>

namespace motionrack::server {

class SenderPort : public std::enable_shared_from_this<SenderPort> {
  public:
    SenderPort(operate::Machine& machine, auth::ControlLease& lease, const GrblPortSettings& settings);

    /// Receives the output, on the motion thread. Set before Machine::run.
    std::function<void(PortMessage)> send;

    // ---- from the network thread
    /// Starts the session of a new writer and greets it. `address`: "127.0.0.1:4711" or a path; `id`: unique for the
    /// connection.
    void came(const std::string& user, const std::string& address, const std::string& id);
    void left();
    /// Processes input. `address`: of its client. `then`: called on the motion thread after these bytes were processed.
    void receive(std::string bytes, bool writer, const std::string& address, std::function<void()> then);

    // ---- the motion thread
    void tick();
    void stopped(const operate::StopReport& report);

  private:
    void flush(bool greets = false);
    Result<void> take_control();
    Result<void> may_stop() const;
    void see_control();

    operate::Machine& machine_;
    auth::ControlLease& lease_;
    const bool resets_stop_all_;
    std::unique_ptr<grbl::GrblSession> session_;
    std::string user_ = "a sender", address_, id_ = "grbl";  ///< the current writer
    std::string speaker_;                                    ///< address of the client whose bytes are processed
    bool had_control_ = false;                               ///< the writer took it, and no other client has since
};

}  // namespace motionrack::server
