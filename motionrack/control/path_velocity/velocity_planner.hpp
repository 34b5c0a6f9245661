// The speed along a path from rest to rest: as fast as speed, acceleration and jerk allow, place by place.
//
//   w, the square of the speed, over the path u. Acceleration is w'/2, jerk is sqrt(w) w''/2:
//   conditions on w, its slope and its bend.
//
//      ┌──────────┐    ┌───────┐        1. limits of the spans, cut into cells
//      │          │    │       │        2. from the left: as steep as can be, its slope growing as the jerk allows (╱)
//     ╱│╲        ╱│╲__╱│╲     ╱│╲       3. from the right: the same (╲)
//    ╱   ╲______╱   valleys     ╲       4. the lesser of both bends upwards no more than the jerk allows; what bends
//                                          downwards too much is cut off below: the greatest function under it that
//                                          bends no more is a convex hull (w + C is convex, where C'' is the bend
//                                          that the jerk allows)
//
// All is done with the control points of a parabola in each cell (a quadratic B-spline): slopes are between neighbours,
// bends are their differences, and the curve lies between the points. What holds for the points holds at every place.
// See docs/decisions/0011-feed-profile.md.
#pragma once

#include <motionrack/control/path_velocity/limit_interval.hpp>
#include <motionrack/control/path_velocity/profile_segment.hpp>
#include <span>
#include <vector>

namespace motionrack::control {

/// The motion where a path begins.
struct InitialPathState {
    double velocity2 = 0;        ///< of the speed; 0: rest
    double velocity2_slope = 0;  ///< of the square over the path: twice the acceleration
};

struct VelocityPlannerSettings {
    double cell_seconds = 0.004;  ///< a cell takes about so long at its limit
    int refinements = 3;          ///< steps from a safe to a tight idea of the speed, on which the jerk's bend depends
};

/// Allocates only when a path is longer than all before it.
class VelocityPlanner {
  public:
    explicit VelocityPlanner(VelocityPlannerSettings settings = {}) : settings_(settings) {}

    /// From rest to rest over these spans, whose limits are above 0. The answer is valid until the next call; empty
    /// without spans.
    std::span<const ProfileSegment> plan(std::span<const LimitInterval> spans);

    /// The same from a motion that goes on. Empty if none was found that keeps the limits: perhaps there is none.
    std::span<const ProfileSegment> plan_from(const InitialPathState& start, std::span<const LimitInterval> spans);

    /// The same, but the times of its cells are only about right until settle() is called for them.
    std::span<const ProfileSegment> plan_approximate(const InitialPathState& start,
                                                     std::span<const LimitInterval> spans);

    /// Over the same way, where limits have changed a little: sought near what was found last.
    std::span<const ProfileSegment> replan_approximate(std::span<const LimitInterval> spans);

  private:
    static constexpr double rounding = 1e-7;  ///< of a limit: so much beyond it a motion may begin
    /// What a cell asks, and its control point.
    struct Cell {
        double begin = 0, length = 0;
        double velocity2 = 0;            ///< greatest
        double up = 0;                   ///< greatest slope of speeding up
        double down = 0;                 ///< and of slowing down
        double velocity2_curvature = 0;  ///< greatest, times the speed
    };
    /// Of the hull, from control point `from`: what the slope falls between its ends, and what the square loses by it.
    struct Edge {
        std::size_t from = 0;
        double length = 0, fall = 0, moment = 0, rise = 0;
        double slope_in() const { return (rise + moment) / length; }
        double slope_out() const { return slope_in() - fall; }
    };
    /// A stretch of constant jerk from or into rest.
    struct End {
        double length = 0, jerk = 0;
    };

    bool moving() const { return start_.velocity2 > 0; }
    void measure_length(std::span<const LimitInterval> spans);
    std::span<const ProfileSegment> sketch(std::span<const LimitInterval> spans, bool again);
    void solve_from_limits();
    void solve_from_previous();
    void refine();
    void build_cells(std::span<const LimitInterval> spans);
    End end_of(std::span<const LimitInterval> spans, bool back) const;
    double target_cell_length(const LimitInterval& span) const;
    double first_size(double wanted) const;
    void compute_cell_sizes(std::span<const LimitInterval> spans);
    void add_cell(std::span<const LimitInterval> spans, std::size_t at, double begin, double end);
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
    void evaluate_hull_edge(const Edge& edge, std::size_t to);
    void write();
    void write_s_curve(const LimitInterval& limits);
    void write_travel(const LimitInterval& limits);

    VelocityPlannerSettings settings_;
    InitialPathState start_;
    bool can_start_ = true;  ///< start_ is within the limits of the first cells
    bool stalls_ = false;    ///< it slows down so hard that it comes to a stand before its end
    bool found_ = true;      ///< what was sought last goes on from start_
    double length_ = 0;
    End launch_, landing_;
    std::vector<double> ends_;   ///< of the spans
    std::vector<double> sizes_;  ///< greatest cell at each end of a span
    std::vector<Cell> cells_;
    // by knot: 0 the launch's end, cells().size() the landing's begin
    std::vector<double> up_, down_;  ///< steepest slopes
    std::vector<double> way_;        ///< between the control points beside it
    // by control point: 0 and cells().size() + 1 are the rests
    std::vector<double> bound_, left_, right_, square_;
    std::vector<double> fall_;  ///< the most that the slope may fall there
    std::vector<Edge> edges_;
    std::vector<ProfileSegment> pieces_, before_;
};

}  // namespace motionrack::control
