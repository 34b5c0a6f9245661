// Properties of a trajectory at every instant, densely sampled. Axes are within their limits, continuous, on the path,
// at the feed rate and finally at standstill. The motion is not faster than the minimum duration.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/path/junction.hpp>
#include <motionrack/control/trajectory/min_duration.hpp>
#include <motionrack/control/trajectory/test/offline_trajectory_support.hpp>
#include <motionrack/control/trajectory/test/wild_programs.hpp>
#include <string>

namespace motionrack::control::trajectory_test {

/// Violated property and its excess; an empty name: no violation.
struct Fault {
    std::string name, text;
};

class TrajectoryChecks {
  public:
    explicit TrajectoryChecks(const WildProgram& program) : program_(program), limits_(program.limits) {
        Point at = program.start;
        for (const Move& move : program.moves) {
            paths_.push_back(geometry_of(move, at));
            at = move.end;
        }
        double pulses = 0;
        for (std::size_t i = 0; i < 3; ++i) pulses = std::max(pulses, limits_[i].pulses_per_unit);
        half_pulse_ = 0.5 / pulses;
    }

    /// Returns the first violation.
    Fault find() {
        const std::vector<KeptStretch> offline_trajectory = kept_trajectory(program_.moves, limits_, program_.start);
        last_ = {};
        last_.position = program_.start;
        for (std::size_t i = 0; i < offline_trajectory.size() && fault_.name.empty(); ++i) {
            if (offline_trajectory[i].curve.empty()) continue;
            std::size_t next = i + 1;
            while (next < offline_trajectory.size() && offline_trajectory[next].curve.empty() &&
                   offline_trajectory[next].section.rest_seconds == 0)
                ++next;
            // The remaining part is sampled together with the next section.
            const double overlap = next < offline_trajectory.size() ? offline_trajectory[next].section.overlap : 0;
            check(offline_trajectory[i], offline_trajectory[i].section.seconds - overlap, overlap == 0);
        }
        if (fault_.name.empty() && !program_.moves.empty()) check_end();
        return fault_;
    }

  private:
    static constexpr double slack = 1 + 1e-6;
    static constexpr double time_rounding = 1e-13;
    /// Where a feed rate ends on a curve, the cells of the bound are too slow by this share.
    static constexpr double bound_rounding = 3e-3;
    /// At the ends of curve and profile segments, rounding of the position on the path decides which of them are
    /// sampled together. Samples keep this share of a segment away from them, and this share of the position.
    static constexpr double beside = 1e-7, beside_place = 4e-15;

    void fail(const char* name, double by, const std::string& text) {
        if (fault_.name.empty()) fault_ = {name, fmt::format("{} ({:.9g} of what is allowed): {}", name, by, text)};
    }
    void hold(const char* name, double value, double max, const KeptStretch& kept, double time,
              const TrajectoryPoint& state) {
        if (!(value <= max))
            fail(name, value / max,
                 fmt::format("{:.9g} > {:.9g} at {:.9g} s of {:.9g} s, u {:.9g}, line {}", value, max, time,
                             kept.section.seconds, state.u, state.line));
    }

    void check(const KeptStretch& kept, double until, bool ends) {
        const PathSection section = kept.view();
        if (!(section.seconds > 0 && section.seconds < 1e15))
            return fail("finite time", section.seconds, fmt::format("{}", section.seconds));
        SectionSampler view(section);
        last_time_ = 0;
        looks_ = 0;
        const double hair_before = hair_;
        hair_ = time_rounding * section.seconds;
        double begin = 0;
        std::size_t piece = 0;
        for (const ProfileSegment& feed : kept.feed) {
            std::size_t pieces = 0;
            while (piece < kept.curve.size() && kept.curve[piece].begin < feed.begin + feed.length) ++piece, ++pieces;
            const std::size_t looks = std::min<std::size_t>(200, 6 + 4 * pieces);
            const double away = std::clamp(beside_place * (feed.begin + feed.length) / feed.length, beside, 0.5);
            for (std::size_t i = 0; i <= looks; ++i) {
                const double time =
                    begin +
                    feed.seconds * std::clamp(static_cast<double>(i) / static_cast<double>(looks), away, 1 - away);
                if (time > until) break;
                poll(kept, view, time, std::max(hair_, looks_ == 0 ? hair_before : 0));
                if (!fault_.name.empty()) return;
            }
            begin += feed.seconds;
        }
        if (!ends)
            poll(kept, view, until, hair_);
        else
            last_ = view.at(until);
        if (ends) check_rest(kept);
        const double min_duration = min_duration_s(kept.curve, limits_);
        if (!(section.seconds >= min_duration * (1 - bound_rounding)))
            fail("bound", min_duration / section.seconds,
                 fmt::format("{:.9g} s, the bound {:.9g} s, line {}", section.seconds, min_duration, section.line));
    }

    void poll(const KeptStretch& kept, SectionSampler& view, double time, double hair) {
        if (time < last_time_) return;
        const TrajectoryPoint state = view.at(time);
        const double step = (time - last_time_) * slack + hair;
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            const AxisLimits& axis = limits_[i];
            hold("velocity", std::fabs(state.velocity[i]), axis.max_velocity * slack, kept, time, state);
            hold("acceleration", std::fabs(state.accel[i]), axis.max_accel * slack, kept, time, state);
            if (axis.max_jerk > 0) hold("jerk", std::fabs(state.jerk[i]), axis.max_jerk * slack, kept, time, state);
            hold("jump of place", std::fabs(state.position[i] - last_.position[i]), axis.max_velocity * step + 3e-9,
                 kept, time, state);
            hold("jump of velocity", std::fabs(state.velocity[i] - last_.velocity[i]),
                 axis.max_accel * step + 1e-6 * axis.max_velocity, kept, time, state);
            if (axis.max_jerk > 0)
                hold("jump of acceleration", std::fabs(state.accel[i] - last_.accel[i]),
                     axis.max_jerk * slack * step + (slack - 1) * axis.max_accel, kept, time, state);
        }
        check_feed(kept, state, time);
        if (looks_++ % 4 == 0) check_path(kept, state, time);
        last_ = state;
        last_time_ = time;
    }

    /// Returns the programmed velocity on a move; a skipped move before it may have lengthened it slightly.
    double programmed(std::size_t i) const {
        const Move& move = program_.moves[i];
        if (move.kind == MoveKind::rapid || move.kind == MoveKind::dwell)
            return std::numeric_limits<double>::infinity();
        return move.feed_mode == FeedMode::units_per_second
                   ? move.feed
                   : move.feed * (paths_[i].length * (1 + 1e-9) + 0.02 * half_pulse_);
    }

    void check_feed(const KeptStretch& kept, const TrajectoryPoint& state, double time) {
        const std::size_t i = static_cast<std::size_t>(state.line - 1);
        double max_feed = programmed(i);
        if (time < kept.section.overlap)
            max_feed = std::max(max_feed, programmed(static_cast<std::size_t>(kept.section.before.curve.line - 1)));
        const Point& v = state.velocity;
        const double xyz = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        if (paths_[i].shape == PathShape::nothing) return;
        hold("feed",
             paths_[i].shape == PathShape::rotary ? std::max({std::fabs(v[3]), std::fabs(v[4]), std::fabs(v[5])}) : xyz,
             max_feed * slack, kept, time, state);
    }

    double off_path(const TrajectoryPoint& state, std::size_t i) const {
        const Move& move = program_.moves[i];
        const double tolerance =
            move.path == PathControl::continuous ? std::max(move.tolerance_mm, half_pulse_) : half_pulse_;
        const Point& p = state.position;
        if (paths_[i].shape == PathShape::arc || paths_[i].shape == PathShape::line)
            return distance_to(paths_[i], p[0], p[1], p[2]) - tolerance;
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) square += (p[k] - paths_[i].end[k]) * (p[k] - paths_[i].end[k]);
        return std::sqrt(square) - tolerance;
    }

    void check_path(const KeptStretch& kept, const TrajectoryPoint& state, double time) {
        const auto line = static_cast<std::ptrdiff_t>(state.line - 1),
                   count = static_cast<std::ptrdiff_t>(paths_.size());
        double min_off = std::numeric_limits<double>::infinity();
        for (std::ptrdiff_t away = 0; away < count && !(min_off <= 1e-8); ++away) {
            if (line - away >= 0) min_off = std::min(min_off, off_path(state, static_cast<std::size_t>(line - away)));
            if (line + away < count)
                min_off = std::min(min_off, off_path(state, static_cast<std::size_t>(line + away)));
        }
        hold("tolerance", min_off, 1e-8, kept, time, state);
    }

    void check_rest(const KeptStretch& kept) {
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            const double jerk = effective_jerk(limits_[i]);
            hold("rest: velocity", std::fabs(last_.velocity[i]),
                 1e-7 * limits_[i].max_velocity + limits_[i].max_accel * hair_, kept, last_time_, last_);
            hold("rest: acceleration", std::fabs(last_.accel[i]), (slack - 1) * limits_[i].max_accel + jerk * hair_,
                 kept, last_time_, last_);
            hold("rest: place", std::fabs(last_.position[i] - kept.section.end[i]), 3e-9, kept, last_time_, last_);
            last_.velocity[i] = last_.accel[i] = 0;
            last_.position[i] = kept.section.end[i];
        }
    }

    void check_end() {
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            const double off = std::fabs(last_.position[i] - program_.moves.back().end[i]);
            if (!(off <= 3e-9))
                fail("end", off / 3e-9, fmt::format("axis {} is {:.9g} from the program's end", i, off));
        }
    }

    const WildProgram& program_;
    const MachineLimits& limits_;
    std::vector<Geometry> paths_;
    double half_pulse_ = 0;
    Fault fault_;
    TrajectoryPoint last_;
    double last_time_ = 0;
    double hair_ = 0;  ///< rounding error of a time in the section, s
    int looks_ = 0;
};

inline Fault fault_of(const WildProgram& program) {
    return TrajectoryChecks(program).find();
}

/// Removes everything that the fault does not need. Skipped moves shift the following ones.
inline WildProgram reduced(WildProgram program) {
    const std::string name = fault_of(program).name;
    bool changed = true;
    while (changed) {
        changed = false;
        for (std::size_t i = program.moves.size(); i-- > 0;) {
            WildProgram fewer = program;
            fewer.moves.erase(fewer.moves.begin() + static_cast<std::ptrdiff_t>(i));
            if (i == 0) fewer.start = program.moves[0].end;
            for (std::size_t k = 0; k < fewer.moves.size(); ++k) fewer.moves[k].line = static_cast<std::int32_t>(k + 1);
            if (fewer.moves.empty() || fault_of(fewer).name != name) continue;
            program = fewer;
            changed = true;
        }
    }
    return program;
}

inline std::string text_of(const WildProgram& program) {
    std::string out = fmt::format("start {:.17g}\n", fmt::join(program.start, " "));
    for (std::size_t i = 0; i < program.limits.size(); ++i) {
        const AxisLimits& axis = program.limits[i];
        out += fmt::format("{}: velocity {:.9g} accel {:.9g} jerk {:.9g} pulses {:.9g}\n", axis_letters[i],
                           axis.max_velocity, axis.max_accel, axis.max_jerk, axis.pulses_per_unit);
    }
    for (const Move& move : program.moves) {
        out += fmt::format("{} kind {} path {} mode {} feed {:.9g} rapid_override {:.3g} tolerance {:.9g} end {:.17g}",
                           move.line, static_cast<int>(move.kind), static_cast<int>(move.path),
                           static_cast<int>(move.feed_mode), move.feed, move.rapid_override, move.tolerance_mm,
                           fmt::join(move.end, " "));
        if (move.kind == MoveKind::arc)
            out += fmt::format(" plane {}{} centre {:.17g} {:.17g} turns {}", move.first, move.second,
                               move.centre_first, move.centre_second, move.turns);
        if (move.kind == MoveKind::dwell) out += fmt::format(" seconds {:.9g}", move.seconds);
        out += "\n";
    }
    return out;
}

}  // namespace motionrack::control::trajectory_test
