#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/control/look_ahead_planner.hpp>
#include <motionrack/control/rest_profiles.hpp>
#include <motionrack/control/trajectory/offline_trajectory.hpp>
#include <motionrack/rack/plan_picture.hpp>
#include <motionrack/rack/report_segment.hpp>
#include <motionrack/trace/svg.hpp>
#include <vector>

namespace motionrack::rack {

namespace {

constexpr int width = 720, min_path_height = 160, max_path_height = 460, heading_height = 28, chart_height = 120;
/// Number of samples over the whole plan, and minimum per path section.
constexpr double looks = 8000, min_looks = 24;

/// Values over time.
struct Track {
    std::vector<double> seconds;
    std::vector<float> velocity;

    void add(double time, double value) {
        seconds.push_back(time);
        velocity.push_back(static_cast<float>(value));
    }
};

struct AxisTrack {
    std::vector<float> accel, jerk;  ///< fractions of the limits
    bool moves = false;
};

double max_magnitude(double a, double b, double c) {
    return std::max({std::fabs(a), std::fabs(b), std::fabs(c)});
}

/// Samples of the jerk-limited plan.
class Looks {
  public:
    Looks(std::span<const control::Move> moves, const control::MachineLimits& limits, const control::Point& start)
        : limits_(limits) {
        for (const control::Move& move : moves)
            for (std::size_t i = 0; i < 3; ++i)
                linear_ = linear_ || move.kind == control::MoveKind::arc || move.end[i] != start[i];
        drive(moves, start, [this](const control::PathSection& stretch) {
            seconds_ += stretch.seconds - stretch.overlap + stretch.rest_seconds;
        });
        drive(moves, start, [this](const control::PathSection& stretch) { look_at(stretch); });
        if (path.seconds.empty()) add(0, {.position = start});
    }

    Track path;  ///< velocity along XYZ, or of the fastest of ABC if only they move
    std::vector<trace::Xyz> driven;
    std::array<AxisTrack, control::axis_count> axes = {};

    double seconds() const { return seconds_; }
    bool is_linear() const { return linear_; }
    /// Appends standstill up to `time`.
    void rest_until(double time) {
        control::TrajectoryPoint state;
        for (std::size_t i = 0; i < 3; ++i) state.position[i] = driven.back()[i];
        add(time, state);
    }

  private:
    void drive(std::span<const control::Move> moves, const control::Point& start,
               control::OfflineTrajectory::OnSection on_stretch) const {
        control::OfflineTrajectory offline_trajectory(limits_, start, std::move(on_stretch));
        for (const control::Move& move : moves) offline_trajectory.push(move);
        offline_trajectory.flush();
    }

    void look_at(const control::PathSection& stretch) {
        begin_ -= stretch.overlap;
        while (!path.seconds.empty() && path.seconds.back() > begin_) drop();
        if (!stretch.curve.empty()) {
            control::SectionSampler view(stretch);
            const auto count = static_cast<int>(std::max(min_looks, looks * stretch.seconds / seconds_));
            for (int i = 0; i <= count; ++i) {
                const double time = stretch.seconds * i / count;
                add(begin_ + time, view.at(time));
            }
        }
        begin_ += stretch.seconds;
        if (stretch.rest_seconds > 0) {
            if (path.seconds.empty()) add(0, {.position = stretch.end});
            rest_until(begin_);
            rest_until(begin_ += stretch.rest_seconds);
        }
    }

    void add(double time, const control::TrajectoryPoint& state) {
        const control::Point& v = state.velocity;
        path.add(time, linear_ ? std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) : max_magnitude(v[3], v[4], v[5]));
        driven.push_back({state.position[0], state.position[1], state.position[2]});
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const auto part = [](double value, double limit) {
                return static_cast<float>(limit > 0 ? value / limit : 0);
            };
            axes[i].accel.push_back(part(state.accel[i], limits_[i].max_accel));
            axes[i].jerk.push_back(part(state.jerk[i], limits_[i].max_jerk));
            axes[i].moves = axes[i].moves || v[i] != 0;
        }
    }
    void drop() {
        path.seconds.pop_back();
        path.velocity.pop_back();
        driven.pop_back();
        for (AxisTrack& axis : axes) axis.accel.pop_back(), axis.jerk.pop_back();
    }

    const control::MachineLimits& limits_;
    bool linear_ = false;
    double seconds_ = 0, begin_ = 0;
};

/// Corners of the trapezoidal velocity profile; S-curves as chords.
Track corners_of_trapezoids(std::span<const control::Move> moves, const control::MachineLimits& limits,
                            const control::Point& start) {
    Track out;
    double begin = 0;
    control::LookAheadPlanner planner(limits, start);
    control::PlannedMove planned;
    const auto pull = [&] {
        while (planner.pull(planned)) {
            if (planned.move.kind == control::MoveKind::dwell) {
                out.add(begin, 0);
            } else if (planned.jerk > 0) {
                const control::SCurveProfile curve(planned.length, planned.cruise_velocity, planned.accel,
                                                   planned.jerk);
                double from = 0;
                for (const double end : curve.phase_ends()) {
                    for (int i = 0; i <= 5; ++i)
                        out.add(begin + from + (end - from) * i / 5,
                                curve.sample(from + (end - from) * i / 5).velocity);
                    from = end;
                }
            } else {
                const control::TrapezoidalProfile trapezoid(planned.length, planned.entry_velocity,
                                                            planned.exit_velocity, planned.cruise_velocity,
                                                            planned.accel);
                out.add(begin, planned.entry_velocity);
                for (const double end : trapezoid.phase_ends()) out.add(begin + end, trapezoid.sample(end).velocity);
            }
            begin += control::seconds_of(planned);
        }
    };
    for (const control::Move& move : moves) {
        if (!planner.has_room()) pull();
        (void)planner.push(move);
    }
    planner.flush();
    pull();
    out.add(begin, 0);
    return out;
}

/// Samples at equal intervals from 0 to `end`; the last corner is followed by standstill.
Track looked_at(const Track& corners, double end) {
    Track out;
    std::size_t k = 0;
    for (int i = 0; i <= static_cast<int>(looks); ++i) {
        const double time = end * i / looks;
        while (k + 1 < corners.seconds.size() && corners.seconds[k + 1] <= time) ++k;
        const double from = static_cast<double>(corners.velocity[k]);
        if (k + 1 == corners.seconds.size())
            out.add(time, time > corners.seconds[k] ? 0 : from);
        else
            out.add(time, from + (static_cast<double>(corners.velocity[k + 1]) - from) * (time - corners.seconds[k]) /
                                     (corners.seconds[k + 1] - corners.seconds[k]));
    }
    return out;
}

std::vector<trace::SvgChart> charts_of(const Looks& plan, const Track& trapezoids, const RackConfig& config) {
    std::vector<trace::SvgChart> out;
    out.push_back({fmt::format("path velocity, {}/s", plan.is_linear() ? "mm" : "deg"),
                   {{"trapezoids", "b", trapezoids.seconds, trapezoids.velocity},
                    {"jerk-limited", "z", plan.path.seconds, plan.path.velocity}},
                   {}});
    for (const RackAxis& axis : config.axes) {
        const AxisTrack& track = plan.axes[static_cast<std::size_t>(axis.index())];
        if (!track.moves) continue;
        trace::SvgChart chart{fmt::format("{}, part of its limit", axis.letter), {}, {{1, ""}, {-1, ""}}};
        if (axis.max_jerk > 0) chart.series.push_back({"jerk", "c", plan.path.seconds, track.jerk});
        chart.series.push_back({"acceleration", "x", plan.path.seconds, track.accel});
        out.push_back(std::move(chart));
    }
    return out;
}

/// Draws the path from above, or in perspective if it is not flat.
trace::SvgPart path_part(const Looks& plan, std::span<const control::Move> moves, const control::Point& start) {
    trace::ReportData data;
    data.driven = plan.driven;
    control::Point at = start;
    for (const control::Move& move : moves) {
        if (move.kind != control::MoveKind::dwell) data.planned.push_back(path_segment(move, at));
        at = move.end;
    }
    const trace::BoundingBox extent = trace::extent_of_path(data);
    const bool flat = !extent.some || extent.high[2] - extent.low[2] <= 0.05 * extent.diagonal();
    // As wide as possible, with a margin for the marks and the scale.
    const double wide = extent.high[0] - extent.low[0], high = extent.high[1] - extent.low[1];
    const int height =
        std::clamp(flat && wide > 0 ? static_cast<int>(70 + (width - 70) * high / wide) : max_path_height,
                   min_path_height, max_path_height);
    const double peak_velocity =
        static_cast<double>(*std::max_element(plan.path.velocity.begin(), plan.path.velocity.end()));
    return {trace::svg_path(data, flat ? trace::PathView::plan : trace::PathView::perspective, {width, height, false},
                            {plan.path.velocity, peak_velocity, "mm/s"}),
            height};
}

}  // namespace

std::string plan_picture(const std::string& title, std::span<const control::Move> moves, const RackConfig& config,
                         const control::Point& start) {
    const control::MachineLimits limits = config.limits();
    Looks plan(moves, limits, start);
    const Track corners = corners_of_trapezoids(moves, limits, start);
    // All charts share one time axis.
    const double end = std::max(plan.path.seconds.back(), corners.seconds.back());
    plan.rest_until(end);
    const Track planned = looked_at(corners, end);
    const std::vector<trace::SvgChart> charts = charts_of(plan, planned, config);
    const int height = heading_height + chart_height * static_cast<int>(charts.size());
    std::vector<trace::SvgPart> parts;
    if (plan.is_linear()) parts.push_back(path_part(plan, moves, start));
    parts.push_back({trace::svg_timeline("Over time", charts, {}, {width, height, false}), height});
    return trace::svg_column(title, parts, width);
}

}  // namespace motionrack::rack
