// The port of a server: it takes connections as fast as they come, also where no descriptors are left.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <memory>
#include <motionrack/frontends/server/hall.hpp>
#include <vector>

namespace motionrack::server {

/// Descriptors that are kept back: where the process or the computer has no other one, a connection that may ask for
/// STOP gets one of these.
class Reserve {
  public:
    static constexpr std::size_t size = 16;
    Reserve() { refill(); }
    ~Reserve();
    Reserve(const Reserve&) = delete;
    Reserve& operator=(const Reserve&) = delete;
    /// Frees one. False: none is left.
    bool give();
    /// Takes back what is free again.
    void refill();

  private:
    std::vector<int> files_;
};

class Listener {
  public:
    /// `acceptor` does not block.
    Listener(boost::asio::io_context& io, std::shared_ptr<ConnectionPool> hall, boost::asio::ip::tcp::acceptor acceptor,
             std::unique_ptr<boost::asio::ssl::context> tls);
    void begin();
    /// Takes no more, says close_with_reason to all.
    void end();
    bool empty() const { return hall_->open_connections.empty(); }

  private:
    void accept();
    void take_some();
    bool make_room();
    void take(boost::asio::ip::tcp::socket socket);
    void tick();

    boost::asio::io_context& io_;
    boost::asio::ip::tcp::acceptor acceptor_;
    std::unique_ptr<boost::asio::ssl::context> tls_;
    boost::asio::steady_timer pause_, timer_;
    std::shared_ptr<ConnectionPool> hall_;
    Reserve reserve_;
    bool ended_ = false;
};

}  // namespace motionrack::server
