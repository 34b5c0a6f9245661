// Data that the connections of a server share.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/frontends/server/clients.hpp>
#include <motionrack/frontends/server/connection_slots.hpp>
#include <motionrack/frontends/server/handshake_turns.hpp>
#include <motionrack/frontends/server/service.hpp>

namespace motionrack::server {

/// Lives as long as the last of its connections.
struct ConnectionPool {
    explicit ConnectionPool(std::shared_ptr<PanelService> all)
        : service(std::move(all)),
          clients(*service),
          open_connections(service->settings().limits),
          handshakes(service->post()) {}

    std::shared_ptr<PanelService> service;
    Clients clients;
    ConnectionSlots open_connections;
    HandshakeTurns handshakes;
    std::int64_t next_session = 1;
};

}  // namespace motionrack::server
