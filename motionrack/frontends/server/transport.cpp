// Byte streams over TCP, and over TLS on TCP.
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <motionrack/frontends/server/transport.hpp>

namespace motionrack::server {

struct Transport::Tls {
    Tls(asio::ip::tcp::socket socket, asio::ssl::context& context)
        : stream(beast::tcp_stream(std::move(socket)), context) {}
    beast::ssl_stream<beast::tcp_stream> stream;
};

Transport::Transport(asio::ip::tcp::socket socket) : plain_(std::move(socket)) {}

Transport::Transport(asio::ip::tcp::socket socket, asio::ssl::context& tls)
    : tls_(std::make_unique<Tls>(std::move(socket), tls)) {}

Transport::Transport(Transport&&) noexcept = default;
Transport::~Transport() = default;

bool Transport::secure() const {
    return !plain_;
}

beast::tcp_stream& Transport::tcp() {
    return plain_ ? *plain_ : tls_->stream.next_layer();
}

void Transport::handshake(CompletionHandler done) {
    if (plain_) return done({});
    tls_->stream.async_handshake(asio::ssl::stream_base::server,
                                 [done = std::move(done)](error_code error) mutable { done(error); });
}

void Transport::shut_down(CompletionHandler done) {
    if (plain_) return done({});
    tls_->stream.async_shutdown([done = std::move(done)](error_code error) mutable { done(error); });
}

void Transport::read_some(const FirstBuffers<asio::mutable_buffer>& into, CompletionHandler done) {
    if (plain_) return plain_->async_read_some(into, std::move(done));
    tls_->stream.async_read_some(into, std::move(done));
}

void Transport::write_some(const FirstBuffers<asio::const_buffer>& from, CompletionHandler done) {
    if (plain_) return plain_->async_write_some(from, std::move(done));
    tls_->stream.async_write_some(from, std::move(done));
}

void Transport::tear_down(beast::role_type role, CompletionHandler done) {
    using beast::websocket::async_teardown;
    auto end = [done = std::move(done)](error_code error) mutable { done(error); };
    if (plain_) return async_teardown(role, *plain_, std::move(end));
    async_teardown(role, tls_->stream, std::move(end));
}

}  // namespace motionrack::server
