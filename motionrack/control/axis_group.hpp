// Interface of a card's axes that follow a planned path: the executor submits planned moves, the axes execute them.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/base/time.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/planned_move.hpp>
#include <string>
#include <vector>

namespace motionrack::control {

/// Difference between the programmed and the driven path, reported to the user.
struct PathWarning {
    int line = 0;              ///< line of the part program
    std::string what;          ///< sentence without the line number
    double deviation_mm = 0;   ///< largest distance from the programmed path that it adds
    double late_seconds = -1;  ///< delay of a move that arrived too late, so that the axes stopped before it; < 0: none
    Instant at{};              ///< instant of the stop
};

/// Start of a planned move (block >= 0), or standstill of all axes (block = -1).
struct MoveStart {
    std::int64_t block = -1;  ///< number of the planned move, in the order of AxisGroup::follow, from 0
    int line = 0;
    Instant at{};
};

/// Result of a probing move.
struct ProbeResult {
    bool hit = false;  ///< the probe touched, or left
    Point at = {};     ///< axis positions at that instant, as latched by the card; without a hit, the final positions
};

/// Returns the positions of the axes that are present, as "X 10.0000, Y 5.0000".
std::string position_text(const Point& at, const MachineLimits& limits);

/// Returns the error of a requested stop (ErrorKind::stopped), in the wording that all cards share.
tl::unexpected<Error> stopped_on_request(int line, const Point& at, const MachineLimits& limits);

class AxisGroup {
  public:
    virtual ~AxisGroup() = default;
    /// Starts a new path at the current position. Block numbers restart at 0.
    virtual Result<void> begin() = 0;
    /// Returns the card's constraints on junctions and lines; null if it has none.
    virtual const DriveConstraints* drive_constraints() const { return nullptr; }
    /// Submits the next move; returns when the card has room for another one. Errors: ErrorKind::machine if a limit, an
    /// alarm or lost contact stopped the motion (nothing more is executed), ErrorKind::stopped if the user requested a
    /// stop.
    virtual Result<void> follow(const PlannedMove& move) = 0;
    /// Executes the remaining moves; returns at standstill.
    virtual Result<void> finish() = 0;
    /// Executes one straight move from standstill to standstill and stops early if the probe touches (`release`:
    /// leaves). Returns at standstill in both cases; the next move starts there. Requires begin(), and standstill by
    /// finish(). Errors: refused, the card has no probe; machine, the probe touches already (`release`: does not
    /// touch), or as follow().
    virtual Result<ProbeResult> probe(const PlannedMove& move, bool release) {
        (void)move, (void)release;
        return fail(ErrorKind::refused, "The axes of this card have no probe.");
    }
    /// Decelerates to a stop along the path within the acceleration limits (or stops at once) and discards the queue.
    /// Accepted in every state.
    virtual void stop(bool immediate) = 0;
    /// Returns the commanded position from the card's pulse counters.
    virtual Point commanded_position() = 0;
    /// Return the warnings, and the starts of moves, since the last call, oldest first.
    virtual std::vector<PathWarning> take_path_warnings() = 0;
    virtual std::vector<MoveStart> take_move_starts() = 0;
};

}  // namespace motionrack::control
