// Interface of the look-ahead planners: moves are pushed one by one, planned moves are pulled in order.
#pragma once

#include <limits>
#include <motionrack/base/result.hpp>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/control/planned_move.hpp>

namespace motionrack::control {

/// Constraints of the hardware that executes the path, in addition to the limits of the machine.
class DriveConstraints {
  public:
    virtual ~DriveConstraints() = default;
    /// Returns the highest velocity along the path at the junction of two moves, mm/s (degrees/s); infinity without a
    /// limit.
    virtual double max_junction_velocity(const Geometry& before, const Geometry& after) const = 0;
    /// Returns the length at constant velocity that the hardware needs in a move, mm (degrees); 0 .. the length of the
    /// move.
    virtual double constant_velocity_length(const Geometry& path) const = 0;
    /// Returns the number of axes that the hardware interpolates together; one auxiliary axis can run beside them.
    virtual int max_interpolated_axes() const { return axis_count; }
    /// Returns the minimum time between two velocity updates of an auxiliary axis, s.
    virtual double min_velocity_update_s() const { return 0; }
    /// Returns the factor on the path velocity at the junction of two moves while the hardware keeps its pulse rate.
    virtual double velocity_ratio(const Geometry& before, const Geometry& after) const {
        (void)before, (void)after;
        return 1;
    }
    /// Returns the shortest duration of a move, s; a shorter one may end before the hardware has the next move.
    virtual double min_seconds() const { return 0; }
    /// Returns the highest velocity along a move for its shortest duration, mm/s (degrees/s); infinity without a limit.
    virtual double max_velocity(const Geometry& path) const {
        const double seconds = min_seconds();
        return seconds > 0 ? path.length / seconds : std::numeric_limits<double>::infinity();
    }
    /// Returns the delay of a new velocity after the junction of two moves, s; the old velocity applies until then.
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

    /// Adds a move that starts where the last one ended. Requires has_room(). Skips a move of zero length; a dwell ends
    /// the path. Refused, without any change: see checked_path.
    virtual Result<void> push(const Move& move) = 0;

    /// Returns false only while planned moves can be pulled.
    virtual bool has_room() const = 0;

    /// Ends the path at its current end with a standstill, so that all of it can be pulled.
    virtual void flush() = 0;

    /// Returns the next planned move; false if none is ready.
    virtual bool pull(PlannedMove& planned) = 0;

    /// Decelerates to a stop on the path as soon as the limits allow, and has nothing more to pull then. Returns false,
    /// without any change, if it cannot.
    virtual bool hold() { return false; }
};

class PathLimits;

/// Computes the geometry of the move from `start`. Refused: numbers that are not finite, a feed rate that is not above
/// 0, an arc without a plane or turns, a missing axis.
Result<Geometry> checked_path(const Move& move, const Point& start, const PathLimits& limits);

}  // namespace motionrack::control
