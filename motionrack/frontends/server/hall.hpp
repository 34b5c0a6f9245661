// What the connections of a server share.
#pragma once

#include <cstdint>
#include <memory>
#include <motionrack/frontends/server/clients.hpp>
#include <motionrack/frontends/server/seats.hpp>
#include <motionrack/frontends/server/service.hpp>

namespace motionrack::server {

/// It lives as long as the last of its connections.
struct Hall {
    explicit Hall(std::shared_ptr<Service> all)
        : service(std::move(all)), clients(*service), seats(service->settings().limits) {}

    std::shared_ptr<Service> service;
    Clients clients;
    Seats seats;
    std::int64_t next_session = 1;
};

}  // namespace motionrack::server
