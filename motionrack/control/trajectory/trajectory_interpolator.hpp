// Divides a trajectory into straight moves of constant acceleration, for cards that draw lines at a velocity each.
//
//   velocity  ╭───╮            each move spans an interval of the trajectory: as long as path and acceleration are
//           ╱╱     ╲╲          nearly constant on it, but long enough that rounding its ends to whole pulses does not
//          ╱│ │   │ │╲         matter
#pragma once

#include <motionrack/control/path_limits.hpp>
#include <motionrack/control/trajectory/trajectory_generator.hpp>
#include <motionrack/control/trajectory_planner.hpp>

namespace motionrack::control {

struct InterpolatorSettings {
    TrajectoryGeneratorSettings generator;
    /// Maximum duration of a move, above 0 and at most 0.1. Up to four moves are ahead of the axes, which is the delay
    /// of a stop, a hold or an override.
    double max_seconds = 0.01;
    bool cut_dwells = false;                  ///< divides dwells, too
    const DriveConstraints* drive = nullptr;  ///< may be null; must outlive the planner
};

class TrajectoryInterpolator final : public TrajectoryPlanner {
  public:
    /// `start`: the current position, at standstill.
    TrajectoryInterpolator(const MachineLimits& limits, const Point& start, InterpolatorSettings settings = {});

    Result<void> push(const Move& move) override { return push(move, true); }
    /// Adds a move, as push(move). Without `overridable` it ignores the feed override.
    Result<void> push(const Move& move, bool overridable);
    bool has_room() const override { return generator_.has_room(); }
    void flush() override { generator_.flush(); }
    bool pull(PlannedMove& planned) override { return pull(planned, false); }
    bool hold() override {
        generator_.hold();
        return true;
    }
    /// Returns the next planned move; false if none is ready. `early`: start with the known segments although more may
    /// follow.
    bool pull(PlannedMove& planned, bool early);

    /// Returns the generator, for hold, resume and overrides.
    TrajectoryGenerator& generator() { return generator_; }
    const TrajectoryGenerator& generator() const { return generator_; }

  private:
    /// Errors of a move that replaces an interval of the trajectory.
    struct ApproximationError {
        double chord_error = 0;    ///< largest error across or along the path, pulses
        double velocity_step = 0;  ///< velocity step at its junction with the next move, relative to the limit
        double quantisation = 0;   ///< velocity step that half a pulse of rounding causes
    };

    bool has_to_rest(const Geometry& path, std::uint8_t axes) const;
    std::uint8_t axes_of(const Geometry& path) const;
    bool uses_auxiliary_axis(std::uint8_t axes) const;
    double seconds_of_next() const;
    double snap_to_pulses(const TrajectoryPoint& begin, double seconds) const;
    double off_whole_pulses(const Point& begin, const Point& end) const;
    ApproximationError roughness_of(const TrajectoryPoint& begin, double seconds) const;
    double beside(const Point& delta, double per_square, const Point& gone) const;

    MachineLimits limits_;
    PathLimits path_limits_;
    InterpolatorSettings settings_;
    TrajectoryGenerator generator_;
    Geometry last_;                              ///< geometry of the last pushed move
    std::uint8_t last_axes_ = 0, run_axes_ = 0;  ///< axes of the last move, and of all moves since the last standstill
    Point position_;
    double last_seconds_ = 0.005;
    Point planned_position_;  ///< end of the last planned move
};

}  // namespace motionrack::control
