// How many connections a server has, and whose.
//
//   accept ─► caller ─whole head─► seat: 500, of one network 250 ─► HTTP ─► perhaps a WebSocket
//             128       │     └──► no seat: STOP is heard, all else is answered 503
//              │        └ STOP is heard in any case
//              └─► one more: of the older quarter the oldest of the networks that have the most is let go; the others
//                  came so lately that what they have sent may not have been read
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <motionrack/frontends/server/settings.hpp>
#include <string>
#include <string_view>

namespace motionrack::server {

/// An open connection, as the listener sees it.
class OpenConnection {
  public:
    virtual ~OpenConnection() = default;
    /// Ends it; `why` goes to the other end where there is still a place for it.
    virtual void end(std::string_view why) = 0;
};

/// Who has a seat and who only calls. A network is what one stranger may have many addresses of: network_of().
class Seats {
  public:
    explicit Seats(const Limits& limits) : limits_(limits) {}

    /// A connection that has not sent a head so far. May end another one.
    void arrive(OpenConnection* open, const std::string& network);
    /// It has sent a head. True: it has a seat, now or before. False: there is none for it; it goes on as a caller.
    bool take_seat(OpenConnection* open, const std::string& network);
    /// A connection that takes the place of another one (WebSocket).
    void replace(OpenConnection* before, OpenConnection* open);
    void leave(OpenConnection* open);

    /// Ends, of the older quarter of the callers, the oldest of the networks that have the most. False: there is none.
    bool end_a_caller();
    void end_all(std::string_view why);
    bool empty() const { return seats_.empty() && callers_.empty(); }
    std::size_t callers() const { return callers_.size(); }
    std::size_t open_connections() const { return seats_.size(); }

  private:
    struct Caller {
        OpenConnection* open;
        std::string network;
    };
    using Counts = std::map<std::string, std::size_t, std::less<>>;
    static void take_one(Counts& counts, const std::string& network);

    const Limits& limits_;
    std::list<Caller> callers_;  ///< oldest first
    std::map<OpenConnection*, std::list<Caller>::iterator> caller_of_;
    std::map<OpenConnection*, std::string> seats_;
    Counts callers_of_, seats_of_;
};

}  // namespace motionrack::server
