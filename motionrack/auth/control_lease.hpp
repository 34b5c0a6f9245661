// Lease that gives control of the machine to one session at a time.
//
//  free ──take──► held ──release, or 10 s without a keep-alive──► free
//                  │ another's forced take, at standstill or after the holder's connection has ended
//                  ├► held by the other
//                  └──another's STOP──► free
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
    /// Time for which a session without a keep-alive retains control.
    static constexpr std::chrono::seconds life{10};

    struct Holder {
        std::string user, session;
        double since = 0;   ///< s after the lease object was created
        bool left = false;  ///< the holder's connection has ended
    };

    explicit ControlLease(std::function<Moment()> clock = std::chrono::steady_clock::now)
        : clock_(std::move(clock)), made_(clock_()) {}

    /// Gives control to `session`; the holder keeps it. Refused, with the holder's name, if another session holds it
    /// and either `force` is not set, or the machine moves and the holder is connected. A user whose connection ended
    /// regains control without force.
    Result<void> take(std::string_view user, std::string_view session, bool force, bool machine_stands);
    /// Gives control back. Refused: the session does not hold it.
    Result<void> release(std::string_view session);
    /// Renews the control lease. Refused if the session does not hold it.
    Result<void> keep(std::string_view session) { return check(session); }
    /// STOP by this user, in this session if there is one. Ends the control of any other session, whose commands are
    /// refused until it takes control again. Returns true if control was ended.
    bool revoke(std::string_view user, std::string_view session);
    /// Checks that the session holds the lease and renews it; otherwise refused with the holder's name.
    Result<void> check(std::string_view session);
    /// The session's connection has ended; the lease expires by itself.
    void left(std::string_view session);

    std::optional<Holder> holder() const;

  private:
    struct LeaseHolder {
        std::string user, session;
        Moment since, last_sign;
        bool left = false;
    };
    /// Requires the lock.
    bool held() const { return held_ && clock_() - held_->last_sign < life; }
    Result<void> holds(std::string_view session) const;
    std::string name() const { return held_->user.empty() ? "another session" : held_->user; }

    std::function<Moment()> clock_;
    Moment made_;
    mutable std::mutex lock_;
    std::optional<LeaseHolder> held_;
};

}  // namespace motionrack::auth
