// HTTP without TLS.
#include <motionrack/frontends/server/connection.hpp>

namespace motionrack::server {

void serve_plain(asio::ip::tcp::socket socket, Peer peer, std::shared_ptr<Hall> hall) {
    std::make_shared<Connection<PlainStream>>(PlainStream(std::move(socket)), std::move(peer), std::move(hall))
        ->begin();
}

}  // namespace motionrack::server
