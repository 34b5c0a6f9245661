// Accepts connections.
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <unistd.h>

#include <boost/asio/post.hpp>
#include <motionrack/frontends/server/listener.hpp>
#include <motionrack/frontends/server/socket.hpp>

namespace motionrack::server {

using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr std::chrono::milliseconds tick_every{5};
/// Number of connections that are accepted in sequence. Each step of a STOP waits for one such sequence; a flood that
/// is accepted more slowly than it arrives fills the kernel's queue, and then each new client waits for a second.
constexpr int max_taken_at_once = 32;

/// Makes data for a slow reader wait in the client's queue, which drops snapshots, not in the kernel's, which keeps
/// all.
void keep_little_in_the_kernel(tcp::acceptor& acceptor) {
    const int unsent = 16 * 1024;
    ::setsockopt(acceptor.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent, sizeof unsent);
}

}  // namespace

Result<tcp::acceptor> take_port(asio::io_context& io, const asio::ip::address& address, std::uint16_t port) {
    tcp::acceptor acceptor(io);
    error_code error;
    const tcp::endpoint endpoint(address, port);
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
    if (!error) acceptor.set_option(tcp::no_delay(true), error);  // its connections inherit these two
    if (!error) keep_little_in_the_kernel(acceptor);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (!error) acceptor.non_blocking(true, error);
    if (error == asio::error::address_in_use)
        return fail(ErrorKind::io, fmt::format("Port {} of {} is used by another program. Nothing was started; choose "
                                               "another with --port, or 0 for any free one.",
                                               port, address.to_string()));
    if (error == asio::error::access_denied)
        return fail(ErrorKind::io, fmt::format("Port {} may not be used by this user: those below 1024 are root's. "
                                               "Nothing was started; choose another with --port.",
                                               port));
    if (error)
        return fail(ErrorKind::io, fmt::format("{} port {} cannot be served: {}. Nothing was started.",
                                               address.to_string(), port, error.message()));
    return acceptor;
}

DescriptorReserve::~DescriptorReserve() {
    while (give()) continue;
}

bool DescriptorReserve::give() {
    if (files_.empty()) return false;
    ::close(files_.back());
    files_.pop_back();
    return true;
}

void DescriptorReserve::refill() {
    while (files_.size() < size) {
        const int file = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
        if (file < 0) return;
        files_.push_back(file);
    }
}

PortListener::PortListener(asio::io_context& io, std::shared_ptr<ConnectionPool> pool, tcp::acceptor acceptor,
                           std::unique_ptr<asio::ssl::context> tls)
    : io_(io), acceptor_(std::move(acceptor)), tls_(std::move(tls)), pause_(io), timer_(io), pool_(std::move(pool)) {}

void PortListener::begin() {
    accept();
    tick();
}

void PortListener::tick() {
    timer_.expires_after(tick_every);
    timer_.async_wait([this](error_code error) {
        if (error || ended_) return;
        reserve_.refill();
        pool_->service->tick();
        pool_->clients.tick();
        tick();
    });
}

void PortListener::accept() {
    acceptor_.async_wait(tcp::acceptor::wait_read, [this](error_code error) {
        if (!error && !ended_) take_some();
    });
}

void PortListener::take_some() {
    for (int taken = 0; taken < max_taken_at_once; ++taken) {
        error_code error;
        tcp::socket socket(io_);
        acceptor_.accept(socket, error);
        if (!error) {
            take(std::move(socket));
            continue;
        }
        if (error == asio::error::would_block) break;
        const bool is_full = error == asio::error::no_descriptors || error == asio::error::no_buffer_space ||
                             error == asio::error::no_memory || error.value() == ENFILE;
        if (!is_full || close_idle()) continue;  // the connection has closed, or a descriptor is free now
        pause_.expires_after(tick_every);
        pause_.async_wait([this](error_code stopped) {
            if (!stopped && !ended_) accept();
        });
        return;
    }
    accept();
}

bool PortListener::close_idle() {
    return reserve_.give() || pool_->open_connections.end_a_caller();
}

/// Each connection of a flood costs this; everything else waits for its first bytes.
void PortListener::take(tcp::socket socket) {
    error_code closed;  // of a flood, most connections that had to wait
    const asio::ip::address remote = unmapped(socket.remote_endpoint(closed).address());
    if (closed) return;
    Peer peer;
    peer.address = remote.to_string();
    peer.loopback = remote.is_loopback();
    peer.secure = tls_ != nullptr;
    peer.network = network_of(peer.address);
    serve(tls_ ? Transport(std::move(socket), *tls_) : Transport(std::move(socket)), std::move(peer), pool_);
}

void PortListener::end() {
    ended_ = true;
    error_code error;
    acceptor_.close(error);
    timer_.cancel();
    pause_.cancel();
    pool_->open_connections.end_all("The server was stopped.");
}

}  // namespace motionrack::server
