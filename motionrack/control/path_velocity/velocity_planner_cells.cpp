// The cells of a plan: how long a launch and a landing are, and how long cells may be from place to place.
#include <algorithm>
#include <cmath>
#include <motionrack/control/path_velocity/velocity_planner.hpp>

namespace motionrack::control {

namespace {

/// Cells grow away from a rest or a narrow place by this much of the way.
constexpr double radius_growth = 0.25;
/// Beside a narrow place cells take so much of the time that the jerk needs to leave it.
constexpr double unlike_part = 0.25;
/// Where full acceleration is reached sooner than in a cell's time, cells take as long as that, but no less than this
/// part of their time.
constexpr double min_cell_s = 0.1;
/// At least so many cells between two rests, and at most so many of the size that a span's speed asks for.
constexpr double min_feed_cells = 48, max_cells_of_a_span = 256;
/// A launch and a landing take this part of a path at most: on a short one constant jerk ends after a twelfth.
constexpr double max_launch = 1.0 / 14;
constexpr double alike_jerk = 1.5;
/// Of the size that its span asks for is the first cell of a motion that goes on.
constexpr double first_part = 0.1;
/// No cell is shorter than this part of the path: places have no more digits.
constexpr double min_part = 1e-13;

LimitInterval min_of(const LimitInterval& a, const LimitInterval& b) {
    return {a.length, std::min(a.speed, b.speed), std::min(a.accel, b.accel), std::min(a.jerk, b.jerk),
            std::min(a.brake, b.brake)};
}

/// With constant jerk from rest.
double launch_length(double jerk, double seconds) {
    return jerk * seconds * seconds * seconds / 6;
}

}  // namespace

/// As long as acceleration and speed allow with the full jerk, over spans whose jerks are alike, and not so long that
/// the speed cannot come back to what a span ahead allows: one that ends at half of that speed needs no braking, and
/// one of a fourteenth of the way has the room.
VelocityPlanner::End VelocityPlanner::end_of(std::span<const LimitInterval> spans, bool back) const {
    End end{length_ * max_launch, 0};
    LimitInterval least = spans[back ? spans.size() - 1 : 0];
    double before = 0;
    bool within = true;
    for (std::size_t n = 0; n < spans.size() && before * max_launch < end.length; ++n) {
        const LimitInterval& span = spans[back ? spans.size() - 1 - n : n];
        if (within) {
            const LimitInterval all = min_of(least, span);
            const double fits = launch_length(
                all.jerk, std::min((back ? all.brake : all.accel) / all.jerk, std::sqrt(2 * all.speed / all.jerk)));
            const bool alike = span.jerk < alike_jerk * least.jerk && least.jerk < alike_jerk * span.jerk;
            if (n > 0 && (fits <= before || !alike)) {
                end.length = std::min(end.length, before);
                within = false;
            } else {
                least = all;
                end.length = std::min(end.length, fits);
            }
        }
        if (n > 0)
            end.length = std::min(end.length, std::max(before * max_launch,
                                                       launch_length(least.jerk, std::sqrt(span.speed / least.jerk))));
        before += span.length;
        within = within && before < end.length;
    }
    end.jerk = least.jerk;
    return end;
}

/// How long cells should be for a span's own sake.
double VelocityPlanner::target_cell_length(const LimitInterval& span) const {
    const double seconds = std::clamp(std::max(span.accel, span.brake) / span.jerk, min_cell_s * settings_.cell_seconds,
                                      settings_.cell_seconds);
    return std::min(std::max(span.speed * seconds, span.length / max_cells_of_a_span), length_ / min_feed_cells);
}

/// Where a motion goes on: short, since what it does there is taken for what it does all over the cell; no longer than
/// its speed and its acceleration last.
double VelocityPlanner::first_size(double wanted) const {
    const double by_speed = 2 * settings_.cell_seconds * std::sqrt(start_.velocity2),
                 slope = std::fabs(start_.velocity2_slope);
    return std::min({first_part * wanted, by_speed, slope > 0 ? 0.25 * start_.velocity2 / slope : wanted});
}

/// How great cells may be at the ends of the spans: what a span's speed asks for there, and growing away from the
/// narrow ones.
void VelocityPlanner::compute_cell_sizes(std::span<const LimitInterval> spans) {
    sizes_.assign(spans.size() + 1, 0);
    sizes_.front() = moving() ? first_size(target_cell_length(spans.front())) : launch_.length / 3;
    sizes_.back() = landing_.length / 3;
    for (std::size_t k = 1; k < spans.size(); ++k) {
        const LimitInterval least = min_of(spans[k - 1], spans[k]);
        // Between unlike speeds the jerk needs about this time to reach or leave the lesser one.
        const double unlike = 1 - least.speed / std::max(spans[k - 1].speed, spans[k].speed);
        const double seconds = std::min(std::sqrt(least.speed / least.jerk), settings_.cell_seconds);
        const double ramp = unlike > 0 ? unlike_part * least.speed * seconds / unlike : length_;
        sizes_[k] = std::min({target_cell_length(spans[k - 1]), target_cell_length(spans[k]), ramp});
    }
    for (std::size_t k = 1; k < sizes_.size(); ++k)
        sizes_[k] = std::min(sizes_[k], sizes_[k - 1] + radius_growth * spans[k - 1].length);
    for (std::size_t k = sizes_.size() - 1; k-- > 0;)
        sizes_[k] = std::min(sizes_[k], sizes_[k + 1] + radius_growth * spans[k].length);
}

void VelocityPlanner::build_cells(std::span<const LimitInterval> spans) {
    launch_ = moving() ? End{} : end_of(spans, false);
    landing_ = end_of(spans, true);
    compute_cell_sizes(spans);
    cells_.clear();
    const double end = length_ - landing_.length;
    std::size_t at = 0;
    for (double begin = launch_.length; begin < end;) {
        while (at + 1 < spans.size() && ends_[at] <= begin) ++at;
        const double from_left = begin - (ends_[at] - spans[at].length), to_right = ends_[at] - begin;
        double size = std::min({target_cell_length(spans[at]), sizes_[at] + radius_growth * from_left,
                                sizes_[at + 1] + radius_growth / (1 + radius_growth) * to_right});
        size = std::max(size, min_part * length_);
        if (begin + 1.5 * size >= end)
            size = end - begin;
        else if (begin + 2.5 * size >= end)
            size = (end - begin) / 2;
        const double next = size == end - begin ? end : begin + size;
        add_cell(spans, at, begin, next);
        begin = next;
    }
}

/// `at`: the span in which it begins.
void VelocityPlanner::add_cell(std::span<const LimitInterval> spans, std::size_t at, double begin, double end) {
    LimitInterval least = spans[at];
    for (; at + 1 < spans.size() && ends_[at] < end; ++at) least = min_of(least, spans[at + 1]);
    cells_.push_back({begin, end - begin, least.speed * least.speed, 2 * least.accel, 2 * least.brake, 2 * least.jerk});
}

}  // namespace motionrack::control
