// One session at a time controls the machine.
//
//   nobody ──take──► held ──release, or 10 s without a sign of life──► nobody
//                     │ another's take with force, while the machine stands still or the holder's connection has ended
//                     ├► held by the other
//                     └──another's STOP──► nobody
//
// Any thread; every call takes a short lock. A session is a connection or a token: two pages of one user are two
// sessions.
#pragma once

#include <chrono>
#include <functional>
#include <motionrack/base/result.hpp>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace motionrack::auth {

using Moment = std::chrono::steady_clock::time_point;

class ControlLease {
  public:
    /// How long control stays with a session that gives no sign of life.
    static constexpr std::chrono::seconds life{10};

    struct Holder {
        std::string user, session;
        double since = 0;   ///< s since the lease was made
        bool left = false;  ///< his connection has ended
    };

    explicit ControlLease(std::function<Moment()> clock = std::chrono::steady_clock::now)
        : clock_(std::move(clock)), made_(clock_()) {}

    /// Gives control to `session`; one that holds it already keeps it. Refused, with the holder's name: another holds
    /// it, and `force` is not set, or the machine does not stand still and the holder is still connected. A user whose
    /// connection has ended gets it back without force.
    Result<void> take(std::string_view user, std::string_view session, bool force, bool machine_stands);
    /// Refused: the session does not hold it.
    Result<void> release(std::string_view session);
    /// A sign of life. Refused: the session does not hold it.
    Result<void> keep(std::string_view session) { return check(session); }
    /// STOP by this user, in this session where it has one: control of anybody else ends, so that what he goes on
    /// ordering is refused until he takes it again. True: it has ended.
    bool revoke(std::string_view user, std::string_view session);
    /// Whether the session holds it; refused with the holder's name. It is a sign of life.
    Result<void> check(std::string_view session);
    /// The session's connection has ended; the lease runs out by itself.
    void left(std::string_view session);

    std::optional<Holder> holder() const;

  private:
    struct Held {
        std::string user, session;
        Moment since, last_sign;
        bool left = false;
    };
    /// Under the lock.
    bool held() const { return held_ && clock_() - held_->last_sign < life; }
    Result<void> holds(std::string_view session) const;
    std::string name() const { return held_->user.empty() ? "another session" : held_->user; }

    std::function<Moment()> clock_;
    Moment made_;
    mutable std::mutex lock_;
    std::optional<Held> held_;
};

}  // namespace motionrack::auth
