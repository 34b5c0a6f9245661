// Byte streams over TCP, and over TLS on TCP.
#include <algorithm>
#include <boost/asio/ssl/error.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>
#include <motionrack/frontends/server/transport.hpp>
#include <utility>

namespace motionrack::server {

namespace {

// The header of a TLS record: its type, two bytes of the version, two of the length (RFC 8446, 5.1).
constexpr std::size_t header_size = 5, max_record = 16 * 1024, usual_record = 2048;
constexpr char handshake_type = 22;

std::size_t record_size(const std::string& header) {
    const auto byte = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(header[at])}; };
    return header_size + (byte(3) << 8 | byte(4));
}

}  // namespace

struct Transport::Tls {
    Tls(beast::tcp_stream tcp, asio::ssl::context& context) : stream(std::move(tcp), context) {}
    beast::ssl_stream<beast::tcp_stream> stream;
};

Transport::Transport(asio::ip::tcp::socket socket) : plain_(std::move(socket)) {}

Transport::Transport(asio::ip::tcp::socket socket, asio::ssl::context& tls)
    : context_(&tls), plain_(std::move(socket)) {}

Transport::Transport(Transport&&) noexcept = default;
Transport::~Transport() = default;

bool Transport::secure() const {
    return context_ != nullptr;
}

beast::tcp_stream& Transport::tcp() {
    return plain_ ? *plain_ : tls_->stream.next_layer();
}

void Transport::read_hello(CompletionHandler done) {
    hello_.resize(std::max(hello_.size(), usual_record));
    plain_->async_read_some(asio::buffer(&hello_[received_], hello_.size() - received_),
                            [this, done = std::move(done)](error_code error, std::size_t bytes) mutable {
                                received_ += bytes;
                                if (error) return done(error);
                                took_hello(std::move(done));
                            });
}

void Transport::took_hello(CompletionHandler done) {
    const std::size_t size = received_ < header_size ? header_size : record_size(hello_);
    if (hello_.front() != handshake_type || size > header_size + max_record)
        return done(asio::ssl::error::unexpected_result);
    if (received_ >= size) return done({});
    hello_.resize(std::max(hello_.size(), size));
    read_hello(std::move(done));
}

void Transport::handshake(CompletionHandler done) {
    tls_ = std::make_unique<Tls>(std::move(*plain_), *context_);
    plain_.reset();
    tls_->stream.async_handshake(asio::ssl::stream_base::server, asio::buffer(hello_.data(), received_),
                                 [this, done = std::move(done)](error_code error, std::size_t = 0) mutable {
                                     hello_ = std::string();
                                     done(error);
                                 });
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
