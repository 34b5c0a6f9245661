// Taking connections.
#include <netinet/in.h>
#include <netinet/tcp.h>

#include <boost/asio/post.hpp>
#include <motionrack/frontends/server/listener.hpp>

namespace motionrack::server {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr std::chrono::milliseconds tick_every{5};

/// An IPv4 address that came in over IPv6 is told as one.
asio::ip::address plain(const asio::ip::address& address) {
    if (address.is_v6() && address.to_v6().is_v4_mapped())
        return asio::ip::make_address_v4(asio::ip::v4_mapped, address.to_v6());
    return address;
}

/// What waits for a slow reader waits in our queue, which leaves pictures out, and not in the kernel's, which keeps
/// them all.
void keep_little_in_the_kernel(tcp::socket& socket) {
    const int unsent = 16 * 1024;
    ::setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent, sizeof unsent);
}

}  // namespace

Listener::Listener(asio::io_context& io, std::shared_ptr<Hall> hall, tcp::acceptor acceptor,
                   std::unique_ptr<asio::ssl::context> tls)
    : io_(io), acceptor_(std::move(acceptor)), tls_(std::move(tls)), pause_(io), timer_(io), hall_(std::move(hall)) {}

void Listener::begin() {
    accept();
    tick();
}

void Listener::tick() {
    timer_.expires_after(tick_every);
    timer_.async_wait([this](error_code error) {
        if (error || ended_) return;
        hall_->clients.tick();
        tick();
    });
}

void Listener::accept() {
    acceptor_.async_accept(io_, [this](error_code error, tcp::socket socket) {
        if (ended_ || error == asio::error::operation_aborted) return;
        if (!error) {
            take(std::move(socket));
            return accept();
        }
        // Most likely no file descriptors are left: some will come back.
        pause_.expires_after(std::chrono::milliseconds(50));
        pause_.async_wait([this](error_code stopped) {
            if (!stopped && !ended_) accept();
        });
    });
}

void Listener::take(tcp::socket socket) {
    error_code error;
    const tcp::endpoint remote = socket.remote_endpoint(error),
                        local = error ? tcp::endpoint() : socket.local_endpoint(error);
    if (error) return;  // gone already
    socket.set_option(tcp::no_delay(true), error);
    keep_little_in_the_kernel(socket);
    const Limits& limits = hall_->service->settings().limits;
    Peer peer;
    peer.address = plain(remote.address()).to_string();
    peer.local = plain(local.address()).to_string();
    peer.loopback = plain(remote.address()).is_loopback();
    peer.secure = tls_ != nullptr;
    peer.spare = hall_->seats.size() >= limits.connections;
    if (peer.spare && hall_->spare.size() >= limits.spare)
        hall_->spare.front()->end("Too many connections are open; this one was let go for another.");
    if (tls_)
        serve_tls(std::move(socket), *tls_, std::move(peer), hall_);
    else
        serve_plain(std::move(socket), std::move(peer), hall_);
}

void Listener::end() {
    ended_ = true;
    error_code error;
    acceptor_.close(error);
    timer_.cancel();
    pause_.cancel();
    const std::set<Open*> seats = hall_->seats;  // an open one leaves the set when it ends
    const std::list<Open*> spare = hall_->spare;
    for (Open* open : seats) open->end("The server was stopped.");
    for (Open* open : spare) open->end("The server was stopped.");
}

}  // namespace motionrack::server
