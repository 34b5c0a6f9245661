// Jogs of single axes: orders, their leases, and the axes that move by them.
//
//   jog ══ jog ══ jog ──► goes on for the lease after its last order, to the end of its travel at most
//                    └──► over: let go, its session has ended, something stopped it. Only a new jog moves it again.
//
// The lease runs by the clock of the people, whatever the rate of the rack's time; an axis' own hold time, by the
// rack's.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/control/axis.hpp>
#include <optional>
#include <string>
#include <vector>

namespace motionrack::operate {

/// Where an order to jog comes from.
struct JogOrigin {
    std::string session = {};   ///< connection or token; "": nobody's
    std::int64_t sequence = 0;  ///< grows from order to order of a session; 0: not numbered, the newest
    bool renews = false;        ///< only prolongs a jog, and moves nothing where it has ended
};

class Jogs {
  public:
    using Clock = std::function<Instant()>;
    /// Gives an axis of the rack by its letter.
    using Take = std::function<Result<control::Axis*>(char letter)>;
    /// What became of an axis that stands again.
    struct Ended {
        char letter = 'X';
        bool position_valid = false;  ///< the axis trusts its position
        Result<void> how;             ///< ErrorKind::machine: something stopped it; refused: it did not begin
    };

    /// `lease` is of `wall`, which is called on the motion thread.
    Jogs(Duration lease, Clock wall) : lease_(lease), wall_(std::move(wall)) {}

    /// Notes that this order of its session was seen. Refused: a newer one was seen before.
    Result<void> see(const JogOrigin& origin);
    /// Refused: as see(), and a renewal of a jog that has ended.
    Result<void> accept(char letter, const JogOrigin& origin);
    /// Jogs, or goes on; a `speed` of 0 lets go.
    void hold(char letter, double speed, const std::string& session);
    /// Jogs by a distance.
    void move(char letter, double distance, double speed);
    /// The session is gone: its jogs end.
    void end_of(const std::string& session);
    /// Forgets orders and leases; step() ends what still moves.
    void let_go();

    bool any() const { return !orders_.empty() || !moving_.empty(); }
    /// Begins what was ordered, carries on or ends what moves, an axis that is to stop by a ramp; tells what stands. At
    /// least every few ms.
    std::vector<Ended> step(const Take& take, Instant now, const std::function<bool(char letter)>& stops);

  private:
    struct Order {
        char letter = 'X';
        double speed = 0;
        std::optional<double> distance;
    };
    struct Moving {
        char letter = 'X';
        control::Axis* axis = nullptr;
        bool leased = false;  ///< goes on while its lease holds; else to the end of its distance
    };
    struct Lease {
        double speed = 0;
        std::string session;
        Instant until{};
    };
    bool held(char letter) const;
    std::optional<Ended> carry_on(Moving& one, Instant now, bool stop);
    Result<void> begin(const Order& order, const Take& take, Instant now);

    Duration lease_;
    Clock wall_;
    std::vector<Order> orders_;
    std::vector<Moving> moving_;
    std::map<char, Lease> leases_;
    JogOrigin newest_;  ///< of the session that gave a numbered order last
};

}  // namespace motionrack::operate
