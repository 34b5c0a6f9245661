// WebSockets over TLS.
#include <motionrack/frontends/server/stream_connection.hpp>

namespace motionrack::server {

void serve_stream(TlsStream stream, Request request, Peer peer, std::shared_ptr<Hall> hall, Open* before) {
    std::make_shared<StreamConnection<TlsStream>>(std::move(stream), std::move(request), std::move(peer),
                                                  std::move(hall), before)
        ->begin();
}

}  // namespace motionrack::server
