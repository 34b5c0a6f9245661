// Server of a panel, on a separate network thread; listens on loopback by default.
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
    /// Opens the port and starts to serve. Call before Machine::run; panel, door and lease must outlive the object.
    /// Errors: io (the port is in use, a TLS file cannot be read), refused (a non-loopback address without TLS),
    /// invalid_input (invalid address).
    static Result<std::unique_ptr<Server>> open(ServerSettings settings, panel::Panel& panel, auth::Authenticator& door,
                                                auth::ControlLease& lease, Page page);
    ~Server();

    /// Closes all connections with a reason and ends the thread; takes at most a second.
    void stop();

    std::uint16_t port() const;
    /// Returns the address of the page: "http://127.0.0.1:8080/".
    std::string url() const;

    /// Number of WebSocket clients; any thread.
    std::int64_t clients() const;

  private:
    class Inside;
    explicit Server(std::unique_ptr<Inside> inside);
    std::unique_ptr<Inside> inside_;
};

}  // namespace motionrack::server
