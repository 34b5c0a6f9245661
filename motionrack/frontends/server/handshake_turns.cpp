#include <motionrack/frontends/server/handshake_turns.hpp>
#include <utility>

namespace motionrack::server {

void HandshakeTurns::wait(const std::string& network, Begin begin) {
    waiting_[network].push_back(std::move(begin));
    post();
}

void HandshakeTurns::post() {
    if (waiting_.empty() || std::exchange(is_posted_, true)) return;
    (*post_)([this] { next(); });
}

void HandshakeTurns::next() {
    is_posted_ = false;
    bool begun = false;
    while (!begun && !waiting_.empty()) {
        auto turn = waiting_.upper_bound(last_);
        if (turn == waiting_.end()) turn = waiting_.begin();
        last_ = turn->first;
        const Begin begin = std::move(turn->second.front());
        turn->second.pop_front();
        if (turn->second.empty()) waiting_.erase(turn);
        begun = begin();
    }
    post();
}

}  // namespace motionrack::server
