// WebSocket connection of a client.
#include <fmt/format.h>

#include <array>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <motionrack/frontends/server/socket.hpp>
#include <optional>

namespace motionrack::server {

namespace websocket = boost::beast::websocket;

namespace {

class StreamConnection final : public OpenConnection,
                               public MessageSink,
                               public std::enable_shared_from_this<StreamConnection> {
  public:
    /// Takes over the slot of `before`.
    StreamConnection(Transport stream, Request request, Peer peer, std::shared_ptr<ConnectionPool> pool,
                     OpenConnection* before)
        : socket_(std::move(stream)),
          request_(std::move(request)),
          pool_(std::move(pool)),
          client_(std::make_shared<Client>(*pool_->service, std::move(peer), fmt::format("w{}", pool_->next_session++),
                                           *this)) {
        pool_->open_connections.replace(before, this);
    }
    ~StreamConnection() override { leave(); }

    void begin() {
        const Limits& limits = pool_->service->settings().limits;
        socket_.set_option(websocket::stream_base::timeout{limits.header, limits.silence, true});
        socket_.read_message_max(limits.frame);
        socket_.auto_fragment(false);
        socket_.text(true);
        socket_.async_accept(request_, [self = shared_from_this()](error_code error) {
            if (error || self->left_) return;
            self->opened_ = true;
            self->pool_->clients.add(self->client_);
            self->client_->opened();
            self->read();
        });
    }

    // ---- MessageSink
    void write(const OutgoingMessage& message) override {
        writes_ = true;
        std::array<asio::const_buffer, 2> pieces = {asio::buffer(message.own), {}};
        if (message.shared) pieces[1] = asio::buffer(*message.shared);
        socket_.async_write(pieces, [self = shared_from_this()](error_code error, std::size_t) {
            self->writes_ = false;
            if (error) return self->leave();
            if (self->reason_) return self->say_goodbye();
            self->client_->written();
        });
    }

    void allow(std::size_t bytes) override { socket_.read_message_max(bytes); }

    void close(int code, std::string_view reason) override {
        if (!opened_) return socket_.next_layer().tcp().close();  // its handshake is still being written
        reason_.emplace(static_cast<websocket::close_code>(code), beast::string_view(reason.data(), reason.size()));
        if (!writes_) return say_goodbye();
        // A client that does not read would not receive the close frame either.
        if (code == websocket::close_code::try_again_later) return socket_.next_layer().tcp().close();
        close_limit_.expires_after(pool_->service->settings().limits.spare_time);
        close_limit_.async_wait([weak = weak_from_this()](error_code error) {
            const auto self = weak.lock();
            if (self && !error) self->socket_.next_layer().tcp().close();
        });
    }

    // ---- OpenConnection
    void end(std::string_view why) override { client_->close_with_reason(websocket::close_code::going_away, why); }

  private:
    static constexpr std::size_t kept = 256 * 1024;  ///< maximum bytes of a buffer kept by a connection

    void say_goodbye() {
        socket_.async_close(*reason_, [self = shared_from_this()](error_code) { self->leave(); });
    }

    void read() {
        socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
            if (error) return self->leave();
            const auto bytes = self->buffer_.cdata();
            self->client_->message({static_cast<const char*>(bytes.data()), bytes.size()}, self->socket_.got_text());
            self->buffer_.consume(bytes.size());
            if (self->buffer_.capacity() > kept) self->buffer_.shrink_to_fit();
            self->read();
        });
    }

    void leave() {
        if (std::exchange(left_, true)) return;
        client_->closed();
        pool_->clients.remove(client_.get());
        pool_->open_connections.leave(this);
    }

    websocket::stream<Transport, false> socket_;
    Request request_;
    std::shared_ptr<ConnectionPool> pool_;
    std::shared_ptr<Client> client_;
    beast::flat_buffer buffer_;
    std::optional<websocket::close_reason> reason_;
    asio::steady_timer close_limit_{socket_.get_executor()};  ///< ends a close that waits for a pending write
    bool opened_ = false, writes_ = false, left_ = false;
};

}  // namespace

void serve_stream(Transport transport, Request request, Peer peer, std::shared_ptr<ConnectionPool> pool,
                  OpenConnection* before) {
    std::make_shared<StreamConnection>(std::move(transport), std::move(request), std::move(peer), std::move(pool),
                                       before)
        ->begin();
}

}  // namespace motionrack::server
