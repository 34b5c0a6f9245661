// Cells of a plan: lengths of launch and landing, and cell lengths along the path.
#include <algorithm>
#include <cmath>
#include <motionrack/control/path_velocity/velocity_planner.hpp>

namespace motionrack::control {

namespace {

/// Growth of cells away from a standstill or a slow passage, relative to the distance.
constexpr double radius_growth = 0.25;
/// Cell duration beside a slow passage, relative to the time that the jerk needs to leave it.
constexpr double unlike_part = 0.25;
/// If full acceleration is reached faster than one cell duration, cells last as long as that, but at least this share
/// of it.
constexpr double min_cell_s = 0.1;
/// Minimum number of cells between two standstills, and maximum number of the target size in an interval.
constexpr double min_feed_cells = 48, max_cells_of_an_interval = 256;
/// Maximum share of a launch or a landing in the path: on a short path constant jerk ends after a twelfth.
constexpr double max_launch = 1.0 / 14;
constexpr double alike_jerk = 1.5;
/// Size of the first cell of a continued motion, relative to the target of its interval.
constexpr double first_part = 0.1;
/// Minimum relative size of a cell: positions have no more digits.
constexpr double min_part = 1e-13;

LimitInterval min_of(const LimitInterval& a, const LimitInterval& b) {
    return {a.length, std::min(a.velocity, b.velocity), std::min(a.accel, b.accel), std::min(a.jerk, b.jerk),
            std::min(a.brake, b.brake)};
}

/// Returns the length of a launch with constant jerk from standstill.
double launch_length(double jerk, double seconds) {
    return jerk * seconds * seconds * seconds / 6;
}

}  // namespace

/// Returns the launch or landing: as long as acceleration and velocity allow at full jerk, over intervals with equal
/// jerk. The velocity must still be able to return to the limit of an interval ahead. Up to half of that limit this
/// needs no braking, and a launch of a fourteenth of the distance leaves room for it.
VelocityPlanner::End VelocityPlanner::end_of(std::span<const LimitInterval> intervals, bool back) const {
    End end{length_ * max_launch, 0};
    LimitInterval min_limits = intervals[back ? intervals.size() - 1 : 0];
    double before = 0;
    bool within = true;
    for (std::size_t n = 0; n < intervals.size() && before * max_launch < end.length; ++n) {
        const LimitInterval& interval = intervals[back ? intervals.size() - 1 - n : n];
        if (within) {
            const LimitInterval all = min_of(min_limits, interval);
            const double fits = launch_length(
                all.jerk, std::min((back ? all.brake : all.accel) / all.jerk, std::sqrt(2 * all.velocity / all.jerk)));
            const bool alike =
                interval.jerk < alike_jerk * min_limits.jerk && min_limits.jerk < alike_jerk * interval.jerk;
            if (n > 0 && (fits <= before || !alike)) {
                end.length = std::min(end.length, before);
                within = false;
            } else {
                min_limits = all;
                end.length = std::min(end.length, fits);
            }
        }
        if (n > 0)
            end.length = std::min(
                end.length, std::max(before * max_launch,
                                     launch_length(min_limits.jerk, std::sqrt(interval.velocity / min_limits.jerk))));
        before += interval.length;
        within = within && before < end.length;
    }
    end.jerk = min_limits.jerk;
    return end;
}

/// Returns the cell length for the limits of one interval.
double VelocityPlanner::target_cell_length(const LimitInterval& interval) const {
    const double seconds = std::clamp(std::max(interval.accel, interval.brake) / interval.jerk,
                                      min_cell_s * settings_.cell_seconds, settings_.cell_seconds);
    return std::min(std::max(interval.velocity * seconds, interval.length / max_cells_of_an_interval),
                    length_ / min_feed_cells);
}

/// Returns the first cell size of a continued motion. It is short, because the initial state is assumed for the whole
/// cell, and at most as long as its velocity and acceleration last.
double VelocityPlanner::first_size(double wanted) const {
    const double by_velocity = 2 * settings_.cell_seconds * std::sqrt(start_.velocity2),
                 slope = std::fabs(start_.velocity2_slope);
    return std::min({first_part * wanted, by_velocity, slope > 0 ? 0.25 * start_.velocity2 / slope : wanted});
}

/// Computes the largest cell sizes at the ends of the intervals: the target size there, growing with the distance from
/// small ones.
void VelocityPlanner::compute_cell_sizes(std::span<const LimitInterval> intervals) {
    sizes_.assign(intervals.size() + 1, 0);
    sizes_.front() = moving() ? first_size(target_cell_length(intervals.front())) : launch_.length / 3;
    sizes_.back() = landing_.length / 3;
    for (std::size_t k = 1; k < intervals.size(); ++k) {
        const LimitInterval min_limits = min_of(intervals[k - 1], intervals[k]);
        // Between different velocities the jerk needs about this time to reach or leave the lower one.
        const double unlike = 1 - min_limits.velocity / std::max(intervals[k - 1].velocity, intervals[k].velocity);
        const double seconds = std::min(std::sqrt(min_limits.velocity / min_limits.jerk), settings_.cell_seconds);
        const double ramp = unlike > 0 ? unlike_part * min_limits.velocity * seconds / unlike : length_;
        sizes_[k] = std::min({target_cell_length(intervals[k - 1]), target_cell_length(intervals[k]), ramp});
    }
    for (std::size_t k = 1; k < sizes_.size(); ++k)
        sizes_[k] = std::min(sizes_[k], sizes_[k - 1] + radius_growth * intervals[k - 1].length);
    for (std::size_t k = sizes_.size() - 1; k-- > 0;)
        sizes_[k] = std::min(sizes_[k], sizes_[k + 1] + radius_growth * intervals[k].length);
}

void VelocityPlanner::build_cells(std::span<const LimitInterval> intervals) {
    launch_ = moving() ? End{} : end_of(intervals, false);
    landing_ = end_of(intervals, true);
    compute_cell_sizes(intervals);
    cells_.clear();
    const double end = length_ - landing_.length;
    std::size_t at = 0;
    for (double begin = launch_.length; begin < end;) {
        while (at + 1 < intervals.size() && ends_[at] <= begin) ++at;
        const double from_left = begin - (ends_[at] - intervals[at].length), to_right = ends_[at] - begin;
        double size = std::min({target_cell_length(intervals[at]), sizes_[at] + radius_growth * from_left,
                                sizes_[at + 1] + radius_growth / (1 + radius_growth) * to_right});
        size = std::max(size, min_part * length_);
        if (begin + 1.5 * size >= end)
            size = end - begin;
        else if (begin + 2.5 * size >= end)
            size = (end - begin) / 2;
        const double next = size == end - begin ? end : begin + size;
        add_cell(intervals, at, begin, next);
        begin = next;
    }
}

/// Adds the cell from u = `begin` to `end`. `at`: index of the interval in which it starts.
void VelocityPlanner::add_cell(std::span<const LimitInterval> intervals, std::size_t at, double begin, double end) {
    LimitInterval min_limits = intervals[at];
    for (; at + 1 < intervals.size() && ends_[at] < end; ++at) min_limits = min_of(min_limits, intervals[at + 1]);
    cells_.push_back({begin, end - begin, min_limits.velocity * min_limits.velocity, 2 * min_limits.accel,
                      2 * min_limits.brake, 2 * min_limits.jerk});
}

}  // namespace motionrack::control
