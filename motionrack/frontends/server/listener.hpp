// Port of a server: accepts connections at any rate, even without free descriptors.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <motionrack/frontends/server/connection_pool.hpp>
#include <vector>

namespace motionrack::server {

/// Reserved descriptors. If the process or the computer has none left, a connection that may request STOP gets one of
/// these.
class DescriptorReserve {
  public:
    static constexpr std::size_t size = 16;
    DescriptorReserve() { refill(); }
    ~DescriptorReserve();
    DescriptorReserve(const DescriptorReserve&) = delete;
    DescriptorReserve& operator=(const DescriptorReserve&) = delete;
    /// Frees one. Returns false if none is left.
    bool give();
    /// Reserves free descriptors again.
    void refill();

  private:
    std::vector<int> files_;
};

/// Opens a non-blocking listening socket; port 0: any free one. Errors: io, with the remedy.
Result<boost::asio::ip::tcp::acceptor> take_port(boost::asio::io_context& io, const boost::asio::ip::address& address,
                                                 std::uint16_t port);

class PortListener {
  public:
    /// Requires a non-blocking `acceptor`.
    PortListener(boost::asio::io_context& io, std::shared_ptr<ConnectionPool> pool,
                 boost::asio::ip::tcp::acceptor acceptor, std::unique_ptr<boost::asio::ssl::context> tls);
    void begin();
    /// Stops accepting and closes all connections with a reason.
    void end();
    bool empty() const { return pool_->open_connections.empty(); }

  private:
    void accept();
    void take_some();
    bool close_idle();
    void take(boost::asio::ip::tcp::socket socket);
    void tick();

    boost::asio::io_context& io_;
    boost::asio::ip::tcp::acceptor acceptor_;
    std::unique_ptr<boost::asio::ssl::context> tls_;
    boost::asio::steady_timer pause_, timer_;
    std::shared_ptr<ConnectionPool> pool_;
    DescriptorReserve reserve_;
    bool ended_ = false;
};

}  // namespace motionrack::server
