// The plan of the path ahead, as an executor sees it: moves are pushed, planned moves are pulled and submitted, and the
// queue of moves learns which of its entries the machine has passed.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <motionrack/base/port.hpp>
#include <motionrack/control/axis_group.hpp>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/move_queue.hpp>

namespace motionrack::control {

/// Settings of a plan of the path ahead.
struct PathPlanSettings {
    MachineLimits limits = {};
    double accel_reserve = 0;  ///< share of each axis' acceleration that is left to the card, 0 .. 0.5
    LookAheadSettings planner = {};
};

/// Circumstances in which the next planned move is due.
struct PathOutlook {
    bool rest_known = false;  ///< all that follows is in the queue, or known to be nothing yet
    bool path_ends = false;   ///< nothing follows the planned moves before a standstill, whatever is read
    bool brakes = false;      ///< a hold or a stop was requested
    bool begun = false;       ///< the axes have moves of this path
    bool time_left = false;   ///< the axes need no further move yet
};

class PathPlan {
  public:
    virtual ~PathPlan() = default;

    /// Begins again at standstill at `position`; moves that were not submitted are forgotten. `axes` must outlive the
    /// plan.
    virtual void reset(const AxisGroup& axes, const Point& position) = 0;
    /// Returns true if the plan itself brakes for a hold or a stop; false: the axes do, which discards
    /// the submitted moves.
    virtual bool brakes_itself() const { return false; }
    /// Plans a standstill on the path as early as possible, and continues from there.
    virtual void hold() {}
    virtual void resume() {}
    /// Sets the overrides of the moves that were not pulled.
    virtual void set_overrides(MoveQueue& queue, double feed, double rapid, bool brakes) = 0;

    virtual bool has_room() const = 0;
    /// Adds a move of the queue. Requires has_room(). Errors: as TrajectoryPlanner::push.
    virtual Result<void> push(QueueEntry& entry) = 0;
    /// Keeps the next move apart from the last one, as an event stands between them.
    virtual void keep_apart() {}
    /// Returns true if the next planned move should wait for the moves behind it, so that it need not end at
    /// standstill.
    virtual bool waits(const MoveQueue& queue, const PathOutlook& outlook) = 0;
    /// Returns the next planned move; false if there is none. It may stand for several moves of the queue.
    virtual bool pull(const MoveQueue& queue, const PathOutlook& outlook, PlannedMove& planned) = 0;
    /// Returns true if motion may continue although no planned move is ready.
    virtual bool may_go_on(const PathOutlook& outlook) const = 0;

    /// Starts a new path of the axes: forgets the submitted moves of the previous one.
    void begin_path() { blocks_.clear(); }
    /// Notes that a planned move was submitted.
    virtual void submit(MoveQueue& queue, const PlannedMove& planned) = 0;
    /// Notes that the axes have begun the `blocks`-th submitted move after the present one.
    virtual void pass(MoveQueue& queue, std::int64_t blocks) = 0;
    /// Notes that the path ended at standstill: all submitted moves are passed.
    virtual void finish(MoveQueue& queue) = 0;
    /// Returns the number of queued moves in the executing planned move and the next one; the axes may have begun both.
    virtual std::int64_t moves_begun() const { return 0; }
    /// Returns the highest rapid override of the submitted rapids that cannot be slowed down on their way; 0: none.
    double rapid_override() const {
        double highest = 0;
        for (const SubmittedMove& block : blocks_) highest = std::max(highest, block.rapid_override);
        return highest;
    }
    /// Counts all submitted moves as passed, because the path ended or was interrupted.
    void interrupt(MoveQueue& queue) {
        queue.pass_blocks(static_cast<std::int64_t>(blocks_.size()));
        blocks_.clear();
    }

  protected:
    struct SubmittedMove {
        std::int64_t number = 0;    ///< number whose meaning each plan defines
        double rapid_override = 0;  ///< override of a whole rapid that is subject to it
    };
    std::deque<SubmittedMove> blocks_;  ///< submitted moves from the executing one on
};

/// Makes a plan with trapezoidal profiles.
std::unique_ptr<PathPlan> make_trapezoidal_plan(const PathPlanSettings& settings, const AxisGroup& axes,
                                                const Point& start);

/// Makes a plan with limited jerk. `host`: provides the time, to detect that a sender sends no more lines.
std::unique_ptr<PathPlan> make_jerk_limited_plan(const PathPlanSettings& settings, const AxisGroup& axes,
                                                 const Point& start, Interrupt& host);

}  // namespace motionrack::control
