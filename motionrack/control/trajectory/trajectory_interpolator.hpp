// A ride as straight moves whose speed changes evenly, for cards that draw lines and are told a speed for each.
//
//   speed     ╭───╮            each move from one instant of the ride to another: as long as the path
//           ╱╱     ╲╲          hardly bends and the acceleration hardly changes on it, but not so short
//          ╱│ │   │ │╲         that its ends on whole pulses matter
#pragma once

#include <motionrack/control/path_limits.hpp>
#include <motionrack/control/trajectory/trajectory_generator.hpp>
#include <motionrack/control/trajectory_planner.hpp>

namespace motionrack::control {

struct InterpolatorSettings {
    TrajectoryGeneratorSettings rider;
    double max_seconds = 0.1;                 ///< of a move, so that wishes are felt soon; above 0, at most 0.1
    bool cut_dwells = false;                  ///< dwells too
    const DriveConstraints* drive = nullptr;  ///< may be null; must outlive the planner
};

class TrajectoryInterpolator final : public TrajectoryPlanner {
  public:
    /// `start`: where the machine stands, at rest.
    TrajectoryInterpolator(const MachineLimits& limits, const Point& start, InterpolatorSettings settings = {});

    Result<void> push(const Move& move) override { return push(move, true); }
    /// One that is not `overridable` goes at its own feed, whatever the overrides are.
    Result<void> push(const Move& move, bool overridable);
    bool has_room() const override { return rider_.has_room(); }
    void flush() override { rider_.flush(); }
    bool pull(PlannedMove& planned) override { return pull(planned, false); }
    bool hold() override {
        rider_.hold();
        return true;
    }
    /// `early`: what is known is driven although there may be more.
    bool pull(PlannedMove& planned, bool early);

    /// To hold, resume and override.
    TrajectoryGenerator& rider() { return rider_; }
    const TrajectoryGenerator& rider() const { return rider_; }

  private:
    /// What a move from one instant to another costs.
    struct ApproximationError {
        double chord_error = 0;    ///< pulses beside its path, or early or late on it
        double velocity_step = 0;  ///< jump at its joint with the next, in start speeds
        double quantisation = 0;   ///< the jump of a speed that is half a pulse wrong
    };

    bool has_to_rest(const Geometry& path, std::uint8_t axes) const;
    std::uint8_t axes_of(const Geometry& path) const;
    bool uses_auxiliary_axis(std::uint8_t axes) const;
    double seconds_of_next() const;
    double snap_to_pulses(const TrajectoryPoint& begin, double seconds) const;
    double off_whole_pulses(const Point& begin, const Point& end) const;
    ApproximationError roughness_of(const TrajectoryPoint& begin, double seconds) const;
    double beside(const Point& way, double per_square, const Point& gone) const;

    MachineLimits limits_;
    PathLimits path_limits_;
    InterpolatorSettings settings_;
    TrajectoryGenerator rider_;
    Geometry last_;                              ///< of the moves that were pushed
    std::uint8_t last_axes_ = 0, run_axes_ = 0;  ///< of the last one, and of all since the path was to rest
    Point position_;
    double last_seconds_ = 0.005;
    Point place_;  ///< where the last planned move ends
};

}  // namespace motionrack::control
