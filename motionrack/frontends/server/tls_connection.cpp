// HTTP over TLS.
#include <motionrack/frontends/server/connection.hpp>

namespace motionrack::server {

void serve_tls(asio::ip::tcp::socket socket, asio::ssl::context& tls, Peer peer, std::shared_ptr<Hall> hall) {
    std::make_shared<Connection<TlsStream>>(TlsStream(beast::tcp_stream(std::move(socket)), tls), std::move(peer),
                                            std::move(hall))
        ->begin();
}

}  // namespace motionrack::server
