// What looks ahead along a path: moves go in one by one, planned moves come out in order.
#pragma once

#include <motionrack/base/result.hpp>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/control/planned_move.hpp>

namespace motionrack::control {

/// What the hardware that drives the path asks of it beside what the machine does.
class DriveConstraints {
  public:
    virtual ~DriveConstraints() = default;
    /// The greatest speed along the path at the joint of two moves, mm/s (degrees/s); infinity if there is no limit.
    virtual double max_junction_velocity(const Geometry& before, const Geometry& after) const = 0;
    /// The part of a move, mm (degrees), on which the hardware can neither speed up nor slow down; 0 .. its length.
    virtual double constant_velocity_length(const Geometry& path) const = 0;
    /// How many axes it draws together; one more is steered beside these.
    virtual int max_interpolated_axes() const { return axis_count; }
    /// A steered axis is told its speed no more often than after so many s.
    virtual double min_velocity_update_s() const { return 0; }
    /// By what the speed along the path is multiplied at the joint of two moves where the rate of the hardware goes on.
    virtual double speed_ratio(const Geometry& before, const Geometry& after) const {
        (void)before, (void)after;
        return 1;
    }
    /// A move that takes less, s, may be over before the hardware has the next one.
    virtual double min_seconds() const { return 0; }
    /// A new speed counts so long after the joint of two moves, s: until then the old one goes on.
    virtual double late_seconds() const { return 0; }
};

///     for (const Move& move : program) {
///         while (!planner.has_room() && planner.pull(planned)) use(planned);
///         planner.push(move);
///     }
///     planner.flush();
///     while (planner.pull(planned)) use(planned);
class TrajectoryPlanner {
  public:
    virtual ~TrajectoryPlanner() = default;

    /// Adds a move that starts where the last one ended. Needs has_room(). A move of no length is left out; a dwell
    /// ends the path there. Refused, with the planner as it was: see checked_path.
    virtual Result<void> push(const Move& move) = 0;

    /// False only while there are planned moves to pull.
    virtual bool has_room() const = 0;

    /// No move follows for now: the path comes to rest at its present end, and all of it can be pulled.
    virtual void flush() = 0;

    /// The next planned move; false if none is ready.
    virtual bool pull(PlannedMove& planned) = 0;

    /// Comes to rest along the path as soon as the limits allow, and then has nothing more to pull. False: it cannot,
    /// and goes on as planned.
    virtual bool hold() { return false; }
};

class PathLimits;

/// The move from where it begins. Refused: numbers that are not finite, a feed that is not above 0, an arc without a
/// plane or turns, an axis the machine does not have.
Result<Geometry> checked_path(const Move& move, const Point& start, const PathLimits& limits);

}  // namespace motionrack::control
