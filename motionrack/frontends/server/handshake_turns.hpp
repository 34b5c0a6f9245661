// Order of TLS handshakes: a handshake takes longer than all else that a connection needs before its first request, so
// one at a time begins, and then all other work is done first. The networks take turns: a flood from one of them does
// not delay the others.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <motionrack/frontends/server/service.hpp>
#include <string>
#include <utility>

namespace motionrack::server {

class HandshakeTurns {
  public:
    /// Begins a handshake. Returns false if its connection has ended.
    using Begin = std::function<bool()>;
    /// `post`: executes work after the work that waits already.
    explicit HandshakeTurns(std::shared_ptr<NetworkExecutor> post) : post_(std::move(post)) {}
    /// Calls `begin` when the turn of this network has come.
    void wait(const std::string& network, Begin begin);

  private:
    void post();
    void next();

    std::shared_ptr<NetworkExecutor> post_;
    std::map<std::string, std::deque<Begin>> waiting_;  ///< by network
    std::string last_;                                  ///< network of the last turn
    bool is_posted_ = false;
};

}  // namespace motionrack::server
