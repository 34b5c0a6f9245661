// A connection: HTTP requests in sequence until one requests a WebSocket.
//
//  handshake ─► head ─► admitted? ─no─► answer ──────────────────► close, after discarding the rest of the body
//                 ▲         │ yes
//                 │       body ─► PanelService::handle ─► answer ─┐
//                 └──────────────────────────────────────────┘
//
// A timeout closes the connection without an answer.
#include <fmt/format.h>

#include <array>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <motionrack/frontends/server/listener.hpp>
#include <motionrack/frontends/server/socket.hpp>
#include <optional>

namespace motionrack::server {

namespace {

class Connection final : public OpenConnection, public std::enable_shared_from_this<Connection> {
  public:
    Connection(Transport stream, Peer peer, std::shared_ptr<ConnectionPool> pool)
        : stream_(std::move(stream)), peer_(std::move(peer)), pool_(std::move(pool)) {
        pool_->open_connections.arrive(this, peer_.network);
    }
    ~Connection() override { pool_->open_connections.leave(this); }

    void begin() {
        if (!stream_.secure()) return read_head(limits().header);
        expire(limits().header);
        stream_.read_hello(CompletionHandler([self = shared_from_this()](error_code error) {
            if (error) return;
            self->pool_->handshakes.wait(self->peer_.network, [self] { return self->shake_hands(); });
        }));
    }

    void end(std::string_view why) override {
        const auto self = keep_ ? std::move(keep_) : shared_from_this();
        pool_->open_connections.leave(this);
        if (std::exchange(ended_, true)) return;
        auto& socket = stream_.tcp();
        if (!stream_.secure() && !busy_) {  // no answer is pending, so a final 503 can be sent
            const std::string& text = last_word(why);
            error_code error;
            socket.socket().non_blocking(true, error);
            socket.socket().send(asio::buffer(text), 0, error);
            socket.socket().shutdown(asio::ip::tcp::socket::shutdown_send, error);
        }
        socket.close();
    }

  private:
    using Parser = http::request_parser<http::string_body>;
    static bool is_http(error_code error) {
        return error.category() == make_error_code(http::error::bad_method).category();
    }
    const Limits& limits() const { return pool_->service->settings().limits; }
    bool shake_hands() {
        if (ended_) return false;
        stream_.handshake(CompletionHandler([self = shared_from_this()](error_code error) {
            if (!error) self->read_head(self->limits().header);
        }));
        return true;
    }
    void expire(std::chrono::milliseconds time) {
        stream_.tcp().expires_after(peer_.stop_only ? std::min(time, limits().spare_time) : time);
    }

    void read_head(std::chrono::milliseconds time) {
        parser_.emplace();
        parser_->body_limit(boost::none);  // set after admission of the head
        expire(time);
        http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
            if (!self->ended_) self->took_head(error);
        });
    }

    void took_head(error_code error) {
        if (error == http::error::end_of_stream) return close_with_reason();
        if (error == http::error::header_limit || error == http::error::buffer_overflow)
            return answer(http_error(431, "limit", "The header of the request is longer than 8 KiB. Nothing was done."),
                          false);
        if (is_http(error))
            return answer(
                http_error(400, "invalid_input",
                           fmt::format("This is not an HTTP/1.1 request: {}. Nothing was done.", error.message())),
                false);
        if (error) return;
        peer_.local = unmapped(stream_.tcp().socket().local_endpoint(error).address()).to_string();
        peer_.stop_only = !pool_->open_connections.take_slot(this, peer_.network);
        head_ = head_of(parser_->get(), peer_);
        head_.has_more = !parser_->is_done() || (head_.upgrade && buffer_.size() > 0);
        if (head_.upgrade) {
            if (auto refused = pool_->service->refuse_stream(head_)) return answer(std::move(*refused), false);
            expire_never();
            return serve_stream(std::move(stream_), parser_->release(), std::move(peer_), pool_, this);
        }
        admission_ = pool_->service->admit(head_);
        if (admission_.answer) return answer(std::move(*admission_.answer), parser_->keep_alive() && !head_.has_more);
        const auto length = parser_->content_length();
        if (length && *length > admission_.body_limit) return too_large();
        parser_->body_limit(admission_.body_limit);
        if (!head_.has_more) return handle();
        if (beast::iequals(parser_->get()[http::field::expect], "100-continue")) return go_on();
        read_body();
    }

    void too_large() {
        answer(http_error(413, "limit",
                          fmt::format("The body is longer than {} bytes, the limit for this client. Nothing was done.",
                                      admission_.body_limit)),
               false);
    }

    void go_on() {
        static constexpr std::string_view text = "HTTP/1.1 100 Continue\r\n\r\n";
        asio::async_write(stream_, asio::buffer(text), [self = shared_from_this()](error_code error, std::size_t) {
            if (!error) self->read_body();
        });
    }

    void read_body() {
        expire(limits().body);
        http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) {
            if (self->ended_) return;
            if (error == http::error::body_limit) return self->too_large();
            if (is_http(error))
                return self->answer(
                    http_error(400, "invalid_input",
                               fmt::format("The body is not valid HTTP/1.1: {}. Nothing was done.", error.message())),
                    false);
            if (!error) self->handle();
        });
    }

    void handle() {
        expire_never();
        busy_ = true;
        const bool keep_alive = parser_->keep_alive();
        keep_ = shared_from_this();
        pool_->service->handle(head_, admission_, parser_->get().body(),
                               [weak = weak_from_this(), keep_alive](HttpAnswer one) {
                                   const auto self = weak.lock();
                                   if (!self || self->ended_) return;
                                   self->keep_.reset();
                                   self->answer(std::move(one), keep_alive);
                               });
    }

    void expire_never() { stream_.tcp().expires_never(); }

    void answer(HttpAnswer one, bool keep_alive) {
        busy_ = true;
        // The method is known even if a later part of the header is malformed.
        const bool head_only = parser_->get().method() == http::verb::head;
        response_ = response_of(one, head_only, keep_alive && !peer_.stop_only);
        body_ = std::move(one.body);
        expire(limits().body);
        http::async_write(stream_, *response_, [self = shared_from_this()](error_code error, std::size_t) {
            self->busy_ = false;
            if (error) return;
            if (self->response_->keep_alive() && !self->ended_) return self->read_head(self->limits().idle);
            self->close_with_reason();
        });
    }

    /// Shuts down sending and discards further input, so that the answer is not lost on close.
    void close_with_reason() {
        expire(limits().spare_time);
        stream_.shut_down(CompletionHandler([self = shared_from_this()](error_code) { self->shut(); }));
    }
    void shut() {
        error_code error;
        stream_.tcp().socket().shutdown(asio::ip::tcp::socket::shutdown_send, error);
        if (!error) drain();
    }
    void drain() {
        stream_.tcp().async_read_some(asio::buffer(rest_),
                                      [self = shared_from_this()](error_code error, std::size_t bytes) {
                                          self->drained_ += bytes;
                                          if (!error && self->drained_ < self->limits().big_body) self->drain();
                                      });
    }

    Transport stream_;
    Peer peer_;
    std::shared_ptr<ConnectionPool> pool_;
    beast::flat_buffer buffer_{16 * 1024};
    std::optional<Parser> parser_;
    RequestHead head_;
    Admission admission_;
    std::optional<Response> response_;
    std::shared_ptr<const std::string> body_;
    std::array<char, 4096> rest_;
    std::size_t drained_ = 0;
    bool busy_ = false;  ///< processing a request or sending its answer
    bool ended_ = false;
    std::shared_ptr<Connection> keep_;  ///< keeps the connection alive while the panel processes its request
};

}  // namespace

void serve(Transport transport, Peer peer, std::shared_ptr<ConnectionPool> pool) {
    std::make_shared<Connection>(std::move(transport), std::move(peer), std::move(pool))->begin();
}

}  // namespace motionrack::server
