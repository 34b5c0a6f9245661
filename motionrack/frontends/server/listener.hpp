// The doors of a server: it takes connections, counts them and ends them. Only these files know Boost.
//
//   accept ─► seats left: a connection of 500 ─► HTTP ─► perhaps a WebSocket
//        └──► none left: one of 32 spare ones, for STOP only, for 3 s; when they are all taken the oldest goes
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <list>
#include <memory>
#include <motionrack/frontends/server/clients.hpp>
#include <motionrack/frontends/server/service.hpp>
#include <set>
#include <string>

namespace motionrack::server {

/// An open connection, as the listener sees it.
class Open {
  public:
    virtual ~Open() = default;
    /// Ends it; `why` goes to the other end where there is still a place for it.
    virtual void end(std::string_view why) = 0;
};

/// What the connections of a server share; it lives as long as the last of them.
struct Hall {
    explicit Hall(std::shared_ptr<Service> all) : service(std::move(all)), clients(*service) {}

    std::shared_ptr<Service> service;
    Clients clients;
    std::set<Open*> seats;
    std::list<Open*> spare;  ///< oldest first
    std::int64_t next_session = 1;

    void leave(Open* open) {
        seats.erase(open);
        spare.remove(open);
    }
};

/// Begins to serve a connection that was taken.
void serve_plain(boost::asio::ip::tcp::socket socket, Peer peer, std::shared_ptr<Hall> hall);
void serve_tls(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context& tls, Peer peer,
               std::shared_ptr<Hall> hall);

class Listener {
  public:
    Listener(boost::asio::io_context& io, std::shared_ptr<Hall> hall, boost::asio::ip::tcp::acceptor acceptor,
             std::unique_ptr<boost::asio::ssl::context> tls);
    void begin();
    /// Takes no more, says goodbye to all.
    void end();
    bool empty() const { return hall_->seats.empty() && hall_->spare.empty(); }

  private:
    void accept();
    void take(boost::asio::ip::tcp::socket socket);
    void tick();

    boost::asio::io_context& io_;
    boost::asio::ip::tcp::acceptor acceptor_;
    std::unique_ptr<boost::asio::ssl::context> tls_;
    boost::asio::steady_timer pause_, timer_;
    std::shared_ptr<Hall> hall_;
    bool ended_ = false;
};

}  // namespace motionrack::server
