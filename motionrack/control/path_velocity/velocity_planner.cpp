// Two passes and a convex hull over the cells.
#include <algorithm>
#include <cmath>
#include <motionrack/control/path_velocity/reduced_jerk_profile.hpp>
#include <motionrack/control/path_velocity/velocity_planner.hpp>
#include <motionrack/control/rest_profiles.hpp>

namespace motionrack::control {

namespace {

/// Assumed bound on velocity2 relative to the previous solution: at first, and the factor by which its excess falls.
constexpr double first_guess = 2, guess_falls = 0.3;

/// Lower bound on velocity2 while a motion in progress continues, relative to its initial velocity2.
constexpr double min_square = 1e-6;

bool all_alike(std::span<const LimitInterval> intervals) {
    return std::all_of(intervals.begin(), intervals.end(), [&](const LimitInterval& interval) {
        return interval.velocity == intervals[0].velocity && interval.accel == intervals[0].accel &&
               interval.brake == intervals[0].accel && interval.jerk == intervals[0].jerk;
    });
}

}  // namespace

std::span<const ProfileSegment> VelocityPlanner::plan(std::span<const LimitInterval> intervals) {
    return plan_from({}, intervals);
}

std::span<const ProfileSegment> VelocityPlanner::plan_from(const InitialPathState& start,
                                                           std::span<const LimitInterval> intervals) {
    plan_approximate(start, intervals);
    for (ProfileSegment& piece : pieces_) settle(piece);
    return pieces_;
}

std::span<const ProfileSegment> VelocityPlanner::plan_approximate(const InitialPathState& start,
                                                                  std::span<const LimitInterval> intervals) {
    start_ = start.velocity2 > 0 ? start : InitialPathState{};
    return sketch(intervals, false);
}

std::span<const ProfileSegment> VelocityPlanner::replan_approximate(std::span<const LimitInterval> intervals) {
    before_.swap(pieces_);
    return sketch(intervals, !before_.empty());
}

std::span<const ProfileSegment> VelocityPlanner::sketch(std::span<const LimitInterval> intervals, bool again) {
    measure_length(intervals);
    if (!(length_ > 0)) return pieces_;
    if (all_alike(intervals)) {
        if (moving())
            write_travel(intervals.front());
        else
            write_s_curve(intervals.front());
        return pieces_;
    }
    if (!moving() && write_reduced_jerk_profile(intervals, pieces_)) return pieces_;
    build_cells(intervals);
    if (again)
        solve_from_previous();
    else
        solve_from_limits();
    if (!moving() || found_) write();
    return pieces_;
}

void VelocityPlanner::measure_length(std::span<const LimitInterval> intervals) {
    pieces_.clear();
    ends_.clear();
    length_ = 0;
    for (const LimitInterval& interval : intervals) ends_.push_back(length_ += interval.length);
}

/// Starts from the limits and iterates towards the velocities that they allow.
void VelocityPlanner::solve_from_limits() {
    found_ = can_start_ = true;
    compute_bounds();
    compute_slope_limits();
    forward_backward_pass();
    restore_start();
    refine();
}

/// Starts the iteration from the previous solution.
void VelocityPlanner::solve_from_previous() {
    found_ = can_start_ = true;
    compute_bounds();
    compute_slope_limits();
    left_.assign(cells_.size() + 2, 0);
    std::size_t k = 0, known = before_.size();  // the profile segment with the velocity at this point
    double begin = 0, end = 0;
    const auto square_at = [&](double u) {
        while (k + 1 < before_.size() && before_[k + 1].begin <= u) ++k;
        const ProfileSegment& piece = before_[k];
        if (known != k) {
            begin = piece.at(0).velocity;
            end = piece.last().velocity;
            known = k;
        }
        const double part = std::clamp((u - piece.begin) / piece.length, 0.0, 1.0);
        return begin * begin + part * (end * end - begin * begin);
    };
    double at_begin = cells_.empty() ? 0 : square_at(cells_.front().begin);
    for (std::size_t i = 0; i < cells_.size(); ++i) {
        const double at_end = square_at(cells_[i].begin + cells_[i].length);
        left_[i + 1] = std::max(at_begin, at_end);
        at_begin = at_end;
    }
    refine();
}

/// Iterates from the estimate in left_.
void VelocityPlanner::refine() {
    tighten_limits(left_, first_guess);
    solve();
    double guess = first_guess;
    for (int i = 0; i < settings_.refinements; ++i, guess = 1 + (guess - 1) * guess_falls)
        if (is_loose(guess)) {
            tighten_limits(square_, guess);
            solve();
        }
}

/// Computes the bounds of the control points and their distances.
void VelocityPlanner::compute_bounds() {
    const std::size_t n = cells_.size();
    way_.assign(n + 1, 0);
    bound_.assign(n + 2, 0);
    for (std::size_t i = 0; i < n; ++i)
        bound_[i + 1] = std::min(
            {cells_[i].velocity2, cells_[i == 0 ? 0 : i - 1].velocity2, cells_[std::min(i + 1, n - 1)].velocity2});
    for (std::size_t k = 0; k <= n; ++k)
        way_[k] = 0.5 * ((k == 0 ? 1.5 * launch_.length : cells_[k - 1].length) +
                         (k == n ? 1.5 * landing_.length : cells_[k].length));
    if (!moving()) return;
    // As if a cell like the first came before it: the two points around the start describe the current motion.
    way_[0] = cells_[0].length;
    const double max_velocity2 = bound_[1];
    bound_[1] = start_.velocity2 + 0.5 * start_.velocity2_slope * cells_[0].length;
    bound_[0] = bound_[1] - start_.velocity2_slope * way_[0];
    can_start_ = std::max(start_.velocity2, bound_[1]) <= max_velocity2 * (1 + rounding) &&
                 start_.velocity2_slope <= cells_[0].up * (1 + rounding) &&
                 -start_.velocity2_slope <= cells_[0].down * (1 + rounding);
}

/// Returns true if a tighter bound would change the result: higher curvature or faster slope changes.
bool VelocityPlanner::is_loose(double guess) const {
    for (std::size_t i = 1; i <= cells_.size(); ++i) {
        const Cell& cell = cells_[i - 1];
        const bool eased = std::min(up_[i - 1], up_[i]) < cell.up || std::min(down_[i - 1], down_[i]) < cell.down;
        if ((eased ? bound_[i] : left_[i]) > guess * square_[i]) return true;
    }
    return false;
}

/// Assumes at most `guess` times the previous solution. A lower velocity allows more curvature for the same jerk.
void VelocityPlanner::tighten_limits(const std::vector<double>& found, double guess) {
    for (std::size_t i = moving() ? 2 : 1; i <= cells_.size(); ++i) bound_[i] = std::min(bound_[i], guess * found[i]);
    for (std::size_t i = 0; i < cells_.size(); ++i)
        cells_[i].velocity2 = std::min(cells_[i].velocity2, std::max({bound_[i], bound_[i + 1], bound_[i + 2]}));
}

void VelocityPlanner::solve() {
    compute_slope_limits();
    limit_slope_rates();
    stalls_ = false;
    forward_backward_pass();
    found_ = !moving() || (can_start_ && !stalls_ && left_[1] >= bound_[1]);
    restore_start();
    limit_deceleration_jerk();
    // The initial motion must continue within the jerk limit: then the second point is a corner of the hull.
    if (moving()) found_ = found_ && edges_.size() > 1 && edges_[1].from == 1;
    restore_start();
}

/// Restores the two control points of the start.
void VelocityPlanner::restore_start() {
    if (!moving()) return;
    for (std::size_t i = 0; i < 2; ++i) {
        left_[i] = bound_[i];
        if (i < square_.size()) square_[i] = bound_[i];
    }
}

void VelocityPlanner::forward_backward_pass() {
    accelerate_pass(left_, false);
    accelerate_pass(right_, true);
    for (std::size_t i = 0; i < left_.size(); ++i) left_[i] = std::min(left_[i], right_[i]);
}

/// Computes the maximum slope at each knot. At a standstill it is the slope of the line from (a quarter of the launch,
/// 0) through the end of the launch. Constant jerk of any size gives that w.
void VelocityPlanner::compute_slope_limits() {
    const std::size_t n = cells_.size();
    up_.assign(n + 1, 0);
    down_.assign(n + 1, 0);
    for (std::size_t k = 0; k <= n; ++k) {
        const Cell &before = cells_[k == 0 ? 0 : k - 1], &after = cells_[std::min(k, n - 1)];
        up_[k] = std::min(before.up, after.up);
        down_[k] = std::min(before.down, after.down);
    }
    // Constant jerk: w' = 2 jerk t, u = jerk t^3 / 6.
    const auto end_slope = [](const End& end) { return 2 * end.jerk * cube_root(6 * end.length / end.jerk); };
    if (!moving()) up_.front() = std::min(up_.front(), end_slope(launch_));
    down_.back() = std::min(down_.back(), end_slope(landing_));
}

/// Limits the change of the maximum slope to what the jerk allows. Otherwise a curve that begins where more is allowed
/// would exceed the limit further on.
void VelocityPlanner::limit_slope_rates() {
    limit_slope_rate(up_);
    limit_slope_rate(down_);
}

void VelocityPlanner::limit_slope_rate(std::vector<double>& slopes) const {
    const std::size_t n = cells_.size();
    const auto change = [&](const Cell& cell) {
        return cell.velocity2_curvature / std::sqrt(cell.velocity2) * cell.length;
    };
    for (std::size_t k = 1; k <= n; ++k) slopes[k] = std::min(slopes[k], slopes[k - 1] + change(cells_[k - 1]));
    for (std::size_t k = n; k-- > 0;) slopes[k] = std::min(slopes[k], slopes[k + 1] + change(cells_[k]));
}

// ---- passes

/// Takes the steepest slope from one end, without looking ahead: a lower bound applies at once.
void VelocityPlanner::accelerate_pass(std::vector<double>& out, bool back) {
    const std::size_t n = cells_.size();
    const std::vector<double>& slopes = back ? down_ : up_;
    const auto point = [&](std::size_t i) { return back ? n + 1 - i : i; };
    out.assign(n + 2, 0);
    double slope = 0, square = 0;
    const bool from_motion = moving() && !back;
    const double min_velocity2 = from_motion ? min_square * start_.velocity2 : 0;
    if (from_motion) {
        out[0] = bound_[0];
        out[1] = square = bound_[1];
        slope = start_.velocity2_slope;
    }
    for (std::size_t i = from_motion ? 1 : 0; i <= n; ++i) {
        const double length = way_[back ? n - i : i];
        const double steepest = slopes[back ? n - i : i];
        if (i == 0) {
            slope = steepest;
        } else {
            // Evaluates the jerk limit at an upper bound of the next velocity; in deceleration from an initial motion,
            // at the previous velocity.
            const Cell& cell = cells_[back ? n - i : i - 1];
            const double more = cell.velocity2_curvature * cell.length;
            const double max_velocity2 = square + std::min(steepest, slope + more / std::sqrt(square)) * length;
            slope = std::min(steepest, slope + more / std::sqrt(std::max({max_velocity2, square, out[point(i - 1)]})));
        }
        const std::size_t at = point(i + 1);
        const double next = square + slope * length, bound = moving() && at < 2 ? next : bound_[at];
        if (next > bound) slope = std::max(0.0, (bound - square) / length);
        stalls_ = stalls_ || next < min_velocity2;
        out[at] = square = std::max(std::min(next, bound), min_velocity2);
    }
}

/// Computes the maximum control points below left_ whose downward curvature respects the jerk limit at the velocity of
/// left_: a convex hull. Sums cover only the range between two corners, so that low velocities near a standstill keep
/// their digits.
void VelocityPlanner::limit_deceleration_jerk() {
    const std::size_t n = cells_.size();
    square_.resize(n + 2);
    fall_.assign(n + 2, 0);
    for (std::size_t i = 1; i <= n; ++i)
        fall_[i] = cells_[i - 1].velocity2_curvature / std::sqrt(std::max({left_[i - 1], left_[i], left_[i + 1]})) *
                   cells_[i - 1].length;
    edges_.clear();
    for (std::size_t i = 1; i < n + 2; ++i) {
        HullEdge edge{i - 1, way_[i - 1], 0, 0, left_[i] - left_[i - 1]};
        // The corner between two edges is on the hull if the slope decreases there by less than allowed.
        while (!edges_.empty() && edges_.back().slope_out() - fall_[edge.from] >= edge.slope_in()) {
            const HullEdge& before = edges_.back();
            const double fall = before.fall + fall_[edge.from];
            edge = {before.from, before.length + edge.length, fall + edge.fall,
                    before.moment + fall * edge.length + edge.moment, before.rise + edge.rise};
            edges_.pop_back();
        }
        edges_.push_back(edge);
    }
    for (std::size_t k = 0; k < edges_.size(); ++k)
        evaluate_hull_edge(edges_[k], k + 1 < edges_.size() ? edges_[k + 1].from : n + 1);
}

/// Evaluates the edge from its lower end, where digits count.
void VelocityPlanner::evaluate_hull_edge(const HullEdge& edge, std::size_t to) {
    square_[edge.from] = left_[edge.from];
    square_[to] = left_[to];
    if (left_[edge.from] <= left_[to]) {
        double slope = edge.slope_in();
        for (std::size_t i = edge.from; i + 1 < to; slope -= fall_[++i]) square_[i + 1] = square_[i] + slope * way_[i];
    } else {
        double slope = edge.slope_out();
        for (std::size_t i = to; i > edge.from + 1; slope += fall_[--i])
            square_[i - 1] = square_[i] - slope * way_[i - 1];
    }
}

}  // namespace motionrack::control
