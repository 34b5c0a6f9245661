// Byte stream of a connection, over TCP or TLS. HTTP and WebSocket code use one stream type and one handler type, so
// their templates are compiled once instead of twice.
#pragma once

#include <array>
#include <boost/asio/async_result.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <memory>
#include <optional>
#include <string>

namespace motionrack::server {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;

/// Handler of one operation, called once at its end.
class CompletionHandler {
  public:
    template <class Handler>
    explicit CompletionHandler(Handler handler) : held_(std::make_unique<Held<Handler>>(std::move(handler))) {}
    void operator()(error_code error, std::size_t bytes = 0) {
        HandlerHolder& held = *held_;
        held.call(std::move(held_), error, bytes);
    }

  private:
    struct HandlerHolder {
        HandlerHolder() = default;
        HandlerHolder(const HandlerHolder&) = delete;
        HandlerHolder& operator=(const HandlerHolder&) = delete;
        virtual ~HandlerHolder() = default;
        /// Destroys `self` before running the handler, which may start the next operation.
        virtual void call(std::unique_ptr<HandlerHolder> self, error_code error, std::size_t bytes) = 0;
    };
    template <class Handler>
    struct Held final : HandlerHolder {
        explicit Held(Handler one) : handler(std::move(one)) {}
        void call(std::unique_ptr<HandlerHolder> self, error_code error, std::size_t bytes) override {
            Handler own = std::move(handler);
            self.reset();
            if constexpr (std::is_invocable_v<Handler&, error_code, std::size_t>)
                own(error, bytes);
            else
                own(error);
        }
        Handler handler;
    };
    std::unique_ptr<HandlerHolder> held_;
};

/// First 16 non-empty buffers of a sequence of any type; a read or a write need not transfer all bytes.
template <class Buffer>
class FirstBuffers {
  public:
    template <class Sequence>
    explicit FirstBuffers(const Sequence& sequence) {
        const auto end = asio::buffer_sequence_end(sequence);
        for (auto one = asio::buffer_sequence_begin(sequence); one != end && size_ < buffers_.size(); ++one) {
            const Buffer buffer(*one);
            if (buffer.size() > 0) buffers_[size_++] = buffer;
        }
    }
    const Buffer* begin() const { return buffers_.data(); }
    const Buffer* end() const { return buffers_.data() + size_; }

  private:
    std::array<Buffer, 16> buffers_;
    std::size_t size_ = 0;
};

class Transport {
  public:
    using executor_type = beast::tcp_stream::executor_type;

    explicit Transport(asio::ip::tcp::socket socket);
    Transport(asio::ip::tcp::socket socket, asio::ssl::context& tls);
    Transport(Transport&&) noexcept;
    Transport& operator=(Transport&&) = delete;
    ~Transport();

    bool secure() const;
    /// TCP stream below TLS; it owns the timer.
    beast::tcp_stream& tcp();
    executor_type get_executor() { return tcp().get_executor(); }

    /// Reads the client's first record, of at most 16 KiB, before which TLS takes neither memory nor time. With TLS
    /// only.
    void read_hello(CompletionHandler done);
    /// Performs the TLS handshake. Call once, after read_hello().
    void handshake(CompletionHandler done);
    void shut_down(CompletionHandler done);

    void read_some(const FirstBuffers<asio::mutable_buffer>& into, CompletionHandler done);
    void write_some(const FirstBuffers<asio::const_buffer>& from, CompletionHandler done);
    /// Closes the stream below a WebSocket.
    void tear_down(beast::role_type role, CompletionHandler done);

    // ---- the requirements of Beast
    template <class Sequence, class Handler>
    auto async_read_some(const Sequence& into, Handler&& handler) {
        return asio::async_initiate<Handler, void(error_code, std::size_t)>(
            [this](auto own, const FirstBuffers<asio::mutable_buffer>& buffers) {
                read_some(buffers, CompletionHandler(std::move(own)));
            },
            handler, FirstBuffers<asio::mutable_buffer>(into));
    }
    template <class Sequence, class Handler>
    auto async_write_some(const Sequence& from, Handler&& handler) {
        return asio::async_initiate<Handler, void(error_code, std::size_t)>(
            [this](auto own, const FirstBuffers<asio::const_buffer>& buffers) {
                write_some(buffers, CompletionHandler(std::move(own)));
            },
            handler, FirstBuffers<asio::const_buffer>(from));
    }
    friend void beast_close_socket(Transport& transport) { transport.tcp().close(); }
    template <class Handler>
    friend void async_teardown(beast::role_type role, Transport& transport, Handler&& handler) {
        transport.tear_down(role, CompletionHandler(std::forward<Handler>(handler)));
    }

  private:
    struct Tls;
    void took_hello(CompletionHandler done);
    asio::ssl::context* context_ = nullptr;   ///< nullptr: without TLS
    std::optional<beast::tcp_stream> plain_;  ///< without TLS, or before its handshake
    std::unique_ptr<Tls> tls_;
    std::string hello_;
    std::size_t received_ = 0;  ///< bytes of hello_
};

}  // namespace motionrack::server
