// Jogs of single axes: commands, their leases, and the moving axes.
//
//   jog ══ jog ══ jog ──► continues for the lease after its last command, to the end of its travel at most
//                    └──► ended: released, its session has ended, or a stop. Only a new jog moves the axis again.
//
// The lease runs on the wall clock, whatever the rate of virtual time; an axis' own hold time runs on virtual time.
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

/// Origin of a jog command.
struct JogOrigin {
    std::string session = {};   ///< connection or token; "": no session
    std::int64_t sequence = 0;  ///< increases with each command of a session; 0: not numbered, taken as the newest
    bool renews = false;        ///< only extends a running jog, and moves nothing if the jog has ended
};

class Jogs {
  public:
    using Clock = std::function<Instant()>;
    /// Returns an axis of the rack by its letter.
    using Take = std::function<Result<control::Axis*>(char letter)>;
    /// Returns true if this axis must stop.
    using Stops = std::function<bool(char letter)>;
    /// End of the jog of an axis that is at standstill again.
    struct Ended {
        char letter = 'X';
        bool position_valid = false;  ///< position validity according to the axis
        Result<void> how;             ///< ErrorKind::machine: stopped by the machine; refused: not started
    };

    /// `lease` is measured on `wall`, which is called on the motion thread.
    Jogs(Duration lease, Clock wall) : lease_(lease), wall_(std::move(wall)) {}

    /// Records the sequence number of a session's command. Refused if a newer one was received before.
    Result<void> see(const JogOrigin& origin);
    /// Accepts a jog command for this axis. Refused as for see(), and for a renewal of an ended jog.
    Result<void> accept(char letter, const JogOrigin& origin);
    /// Requests a jog at `speed` (per second; sign: direction) and renews its lease; a `speed` of 0 ends the jog.
    void hold(char letter, double speed, const std::string& session);
    /// Requests a jog by `distance` (mm or degrees) at `speed` (per second), without a lease.
    void move(char letter, double distance, double speed);
    /// Ends the jogs of a closed session.
    void end_of(const std::string& session);
    /// Drops requests and leases; step() ends the motion that has a lease.
    void let_go();

    bool any() const { return !requests_.empty() || !moving_.empty(); }
    /// Starts requested jogs, and continues or ends running ones; axes to stop decelerate with a ramp. Returns the axes
    /// that have reached standstill. Call at least every few ms.
    std::vector<Ended> step(const Take& take, Instant now, const Stops& stops);

  private:
    struct PendingJog {
        char letter = 'X';
        double speed = 0;
        std::optional<double> distance;
    };
    struct Moving {
        char letter = 'X';
        control::Axis* axis = nullptr;
        bool leased = false;  ///< continues while its lease holds; otherwise to the end of its distance
    };
    struct Lease {
        double speed = 0;
        std::string session;
        Instant until{};
    };
    bool held(char letter) const;
    std::optional<Ended> carry_on(Moving& one, Instant now, bool stop);
    Result<void> begin(const PendingJog& request, const Take& take, Instant now, const Stops& stops);

    Duration lease_;
    Clock wall_;
    std::vector<PendingJog> requests_;
    std::vector<Moving> moving_;
    std::map<char, Lease> leases_;
    JogOrigin newest_;  ///< latest numbered command and its session
};

}  // namespace motionrack::operate
