// Connection limits of a server, in total and per network.
//
//  accept ─► caller ─whole head─► slot: 500, per network 250 ─► HTTP ─► possibly a WebSocket
//            128       │     └──► no slot: STOP is executed, all else is answered 503
//             │        └ STOP is executed in any case
//             └─► above 128: among the older quarter, closes the oldest caller of the network with the most callers;
//                 the input of newer ones may not have been read yet
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
    /// Closes it; sends `why` to the other end if it can still be sent.
    virtual void end(std::string_view why) = 0;
};

/// Assigns slots to connections. A network is the address range of one customer: network_of().
class ConnectionSlots {
  public:
    explicit ConnectionSlots(const Limits& limits) : limits_(limits) {}

    /// Adds a connection that has sent no head yet. May close another connection.
    void arrive(OpenConnection* open, const std::string& network);
    /// A connection has sent its head. Returns true if it has a slot, new or existing. Returns false if none is free;
    /// it stays a caller.
    bool take_slot(OpenConnection* open, const std::string& network);
    /// Transfers the slot of a connection to its successor (WebSocket).
    void replace(OpenConnection* before, OpenConnection* open);
    void leave(OpenConnection* open);

    /// Among the older quarter of the callers, closes the oldest of the network with the most callers. Returns false if
    /// no connection is a caller.
    bool end_a_caller();
    void end_all(std::string_view why);
    bool empty() const { return slots_.empty() && callers_.empty(); }
    std::size_t callers() const { return callers_.size(); }
    std::size_t open_connections() const { return slots_.size(); }

  private:
    struct WaitingCaller {
        OpenConnection* open;
        std::string network;
    };
    using Counts = std::map<std::string, std::size_t, std::less<>>;
    static void take_one(Counts& counts, const std::string& network);

    const Limits& limits_;
    std::list<WaitingCaller> callers_;  ///< oldest first
    std::map<OpenConnection*, std::list<WaitingCaller>::iterator> caller_of_;
    std::map<OpenConnection*, std::string> slots_;
    Counts callers_of_, slots_of_;
};

}  // namespace motionrack::server
