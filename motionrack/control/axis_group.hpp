// What a card offers that can follow a planned path: the controller hands over planned moves, the card's axes drive
// them.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/planned_move.hpp>
#include <string>
#include <vector>

namespace motionrack::control {

/// What driving a path differently from how it was programmed costs, told to the user.
struct PathWarning {
    int line = 0;             ///< line of the part program
    std::string what;         ///< a sentence without the line
    double deviation_mm = 0;  ///< greatest distance from the programmed path that it adds
    double late_seconds =
        -1;        ///< a piece of the path came so much too late, and the axes stopped at its start; < 0: none
    Instant at{};  ///< and when
};

/// A planned move really began (block >= 0), or everything came to rest (block = -1).
struct MoveStart {
    std::int64_t block = -1;  ///< number of the planned move, in the order of AxisGroup::follow, from 0
    int line = 0;
    Instant at{};
};

/// How a probing move ended.
struct ProbeResult {
    bool hit = false;  ///< the probe touched, or left
    Point at = {};     ///< where the axes were at that instant, as the card caught it; if not hit, where they stand
};

/// "X 10.0000, Y 5.0000": of the axes that are there.
std::string position_text(const Point& at, const MachineLimits& limits);

/// ErrorKind::stopped, in the words that every card's axes use.
tl::unexpected<Error> stopped_on_request(int line, const Point& at, const MachineLimits& limits);

class AxisGroup {
  public:
    virtual ~AxisGroup() = default;
    /// Prepares a new path from where the axes stand. Blocks count from 0 again.
    virtual Result<void> begin() = 0;
    /// What the card asks of joints; null: nothing.
    virtual const DriveConstraints* drive_constraints() const { return nullptr; }
    /// Takes the next move; returns when the card has room for another one. Errors: ErrorKind::machine where the motion
    /// was stopped by a limit, an alarm or lost contact (nothing more is driven), ErrorKind::stopped where the user
    /// asked to stop.
    virtual Result<void> follow(const PlannedMove& move) = 0;
    /// Drives what is left; returns at standstill.
    virtual Result<void> finish() = 0;
    /// Drives one straight move from rest to rest, and stops where the probe touches (`release`: leaves) on the way.
    /// Returns at standstill, also when it does not; what follows begins there. Needs begin(), and standstill by
    /// finish(). Errors: refused, the card has no probe; machine, the probe touches already (`release`: does not
    /// touch), or as follow().
    virtual Result<ProbeResult> probe(const PlannedMove& move, bool release) {
        (void)move, (void)release;
        return fail(ErrorKind::refused, "The axes of this card have no probe.");
    }
    /// Comes to a stop along the path as quickly as the acceleration allows (or at once) and forgets what was queued.
    /// In every state.
    virtual void stop(bool immediate) = 0;
    /// Where the card's own pulse counters say the axes are.
    virtual Point commanded_position() = 0;
    /// Since the last call, oldest first.
    virtual std::vector<PathWarning> take_path_warnings() = 0;
    virtual std::vector<MoveStart> take_move_starts() = 0;
};

}  // namespace motionrack::control
