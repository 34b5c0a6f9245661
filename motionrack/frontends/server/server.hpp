// The server of a panel: a network thread of its own, loopback unless it is told otherwise.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/auth/authenticator.hpp>
#include <motionrack/auth/control_lease.hpp>
#include <motionrack/base/result.hpp>
#include <motionrack/frontends/server/page.hpp>
#include <motionrack/frontends/server/settings.hpp>
#include <motionrack/panel/panel.hpp>
#include <string>

namespace motionrack::server {

class Server {
  public:
    /// Takes the port and begins to serve. Before Machine::run; panel, door and lease must outlive it.
    /// Errors: io (the port is taken, a TLS file cannot be used), refused (another address than loopback without TLS),
    /// invalid_input (no address).
    static Result<std::unique_ptr<Server>> open(ServerSettings settings, panel::Panel& panel, auth::Authenticator& door,
                                                auth::ControlLease& lease, Page page);
    ~Server();

    /// Says close_with_reason to all and ends the thread; takes a second at most.
    void stop();

    std::uint16_t port() const;
    /// "http://127.0.0.1:8080/"
    std::string url() const;

    /// WebSockets; any thread.
    std::int64_t clients() const;

  private:
    class Inside;
    explicit Server(std::unique_ptr<Inside> inside);
    std::unique_ptr<Inside> inside_;
};

}  // namespace motionrack::server
