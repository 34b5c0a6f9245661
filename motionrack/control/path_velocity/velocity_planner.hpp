// Time-optimal velocity profile along a path from standstill to standstill, within the velocity, acceleration and jerk
// limits of each interval.
//
//   w, the square of the velocity, over the path u. Acceleration is w'/2, jerk is sqrt(w) w''/2:
//   conditions on w, its slope and its curvature.
//
//      ┌──────────┐    ┌───────┐        1. limits of the intervals, divided into cells
//      │          │    │       │        2. forward: the steepest slope, growing as the jerk allows (╱)
//     ╱│╲        ╱│╲__╱│╲     ╱│╲       3. backward: the same (╲)
//    ╱   ╲______╱   valleys     ╲       4. the minimum of both curves upwards no more than the jerk allows; where it
//                                          curves downwards too much it is lowered: the greatest function below it
//                                          with less curvature is a convex hull (w + C is convex, where C'' is the
//                                          curvature that the jerk allows)
//
// The computation uses the control points of a parabola in each cell (a quadratic B-spline). Slopes are between
// neighbours, curvatures are their differences, and the curve lies between the points. A bound on the points holds
// everywhere. See docs/decisions/0011-feed-profile.md.
#pragma once

#include <motionrack/control/path_velocity/limit_interval.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

/// The motion at the start of a path.
struct InitialPathState {
    double velocity2 = 0;        ///< square of the velocity; 0: standstill
    double velocity2_slope = 0;  ///< derivative of velocity2 over the path: twice the acceleration
};

struct VelocityPlannerSettings {
    double cell_seconds = 0.004;  ///< approximate duration of a cell at its limit
    int refinements = 3;          ///< iterations from a safe to a tight estimate of the velocity, which determines the
                                  ///< curvature limit from the jerk
};

/// Allocates only when a path is longer than all previous ones.
class VelocityPlanner {
  public:
    explicit VelocityPlanner(VelocityPlannerSettings settings = {}) : settings_(settings) {}

    /// Plans from standstill to standstill over intervals whose limits are above 0. The result is valid until the next
    /// call; empty without intervals.
    std::span<const ProfileSegment> plan(std::span<const LimitInterval> intervals);

    /// Plans from a motion in progress. Returns an empty span if no feasible plan was found; one may still exist.
    std::span<const ProfileSegment> plan_from(const InitialPathState& start, std::span<const LimitInterval> intervals);

    /// As plan_from(), but the durations of its cells are approximate until settle() is called for them.
    std::span<const ProfileSegment> plan_approximate(const InitialPathState& start,
                                                     std::span<const LimitInterval> intervals);

    /// Replans over the same intervals after a small change of limits; starts the iteration from the previous solution.
    std::span<const ProfileSegment> replan_approximate(std::span<const LimitInterval> intervals);

  private:
    static constexpr double rounding =
        1e-7;  ///< relative violation of a limit that is accepted at the start of a motion
    /// Limits of a cell, and its control point.
    struct Cell {
        double begin = 0, length = 0;
        double velocity2 = 0;            ///< maximum of velocity2
        double up = 0;                   ///< maximum slope of acceleration
        double down = 0;                 ///< maximum slope of deceleration
        double velocity2_curvature = 0;  ///< maximum of the curvature of velocity2 times the velocity
    };
    /// Edge of the hull, from control point `from`: decrease of the slope between its ends, and the resulting loss of
    /// velocity2.
    struct HullEdge {
        std::size_t from = 0;
        double length = 0, fall = 0, moment = 0, rise = 0;
        double slope_in() const { return (rise + moment) / length; }
        double slope_out() const { return slope_in() - fall; }
    };
    /// Interval of constant jerk from or to standstill.
    struct End {
        double length = 0, jerk = 0;
    };

    bool moving() const { return start_.velocity2 > 0; }
    void measure_length(std::span<const LimitInterval> intervals);
    std::span<const ProfileSegment> sketch(std::span<const LimitInterval> intervals, bool again);
    void solve_from_limits();
    void solve_from_previous();
    void refine();
    void build_cells(std::span<const LimitInterval> intervals);
    End end_of(std::span<const LimitInterval> intervals, bool back) const;
    double target_cell_length(const LimitInterval& interval) const;
    double first_size(double wanted) const;
    void compute_cell_sizes(std::span<const LimitInterval> intervals);
    void add_cell(std::span<const LimitInterval> intervals, std::size_t at, double begin, double end);
    void compute_bounds();
    bool is_loose(double guess) const;
    void tighten_limits(const std::vector<double>& found, double guess);
    void solve();
    void restore_start();
    void forward_backward_pass();
    void compute_slope_limits();
    void limit_slope_rates();
    void limit_slope_rate(std::vector<double>& slopes) const;
    void accelerate_pass(std::vector<double>& out, bool back);
    void limit_deceleration_jerk();
    void evaluate_hull_edge(const HullEdge& edge, std::size_t to);
    void write();
    void write_s_curve(const LimitInterval& limits);
    void write_travel(const LimitInterval& limits);

    VelocityPlannerSettings settings_;
    InitialPathState start_;
    bool can_start_ = true;  ///< start_ is within the limits of the first cells
    bool stalls_ = false;    ///< the initial motion would stop before the end, because it decelerates too hard
    bool found_ = true;      ///< the last solution continues from start_
    double length_ = 0;
    End launch_, landing_;
    std::vector<double> ends_;   ///< u at the ends of the intervals
    std::vector<double> sizes_;  ///< largest cell size at each end of an interval
    std::vector<Cell> cells_;
    // one entry per knot: 0 the end of the launch, cells().size() the start of the landing
    std::vector<double> up_, down_;  ///< steepest slopes
    std::vector<double> way_;        ///< distance between the control points on either side
    // one entry per control point: 0 and cells().size() + 1 are the standstills
    std::vector<double> bound_, left_, right_, square_;
    std::vector<double> fall_;  ///< largest decrease of the slope at the point
    std::vector<HullEdge> edges_;
    std::vector<ProfileSegment> pieces_, before_;
};

}  // namespace motionrack::control
