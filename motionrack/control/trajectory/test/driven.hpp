// A trajectory generator that is advanced in small steps and checked at every step.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <motionrack/control/path/test/path_builder_support.hpp>
#include <motionrack/control/trajectory/trajectory_generator.hpp>
#include <random>
#include <utility>
#include <vector>

namespace motionrack::control::trajectory_test {

using curve_test::arc_from;
using curve_test::line_to;
using curve_test::machine;

inline constexpr double slack = 1 + 1e-6;

/// Makes lines (some of them many and short, some with Z), arcs, and dwells.
inline std::vector<Move> program(std::mt19937& random) {
    const auto between = [&](double a, double b) { return std::uniform_real_distribution<>(a, b)(random); };
    const auto one_of = [&](unsigned n) { return random() % n == 0; };
    std::vector<Move> out;
    const bool chords = one_of(3), exact = one_of(4), arcs = !chords && one_of(2);
    const double tolerance = std::exp(between(std::log(0.003), std::log(0.3)));
    double angle = 0;
    Point position = {};
    for (auto n = 5 + random() % 60; n > 0; --n) {
        const Point from = position;
        const double length = chords ? 0.3 : std::exp(between(std::log(0.05), std::log(30.0)));
        angle += chords ? between(-0.3, 0.3) : between(-2.5, 2.5);
        position[0] += length * std::cos(angle);
        position[1] += length * std::sin(angle);
        if (one_of(5)) position[2] += between(-1, 1);
        Move move = line_to(position, tolerance);
        if (arcs && one_of(2)) {
            const double sweep = between(-3, 3);
            move = arc_from(from, angle, between(0.2, 12), sweep, tolerance);
            position = move.end;
            angle += sweep;
        }
        if (exact) move.path = PathControl::exact_path;
        move.feed = between(5, 120);
        if (one_of(8)) move.kind = MoveKind::rapid;
        move.line = static_cast<int>(out.size()) + 1;
        out.push_back(move);
        if (!one_of(25)) continue;
        move.kind = MoveKind::dwell;
        move.seconds = 0.05;
        out.push_back(move);
    }
    return out;
}

/// Pushes available moves while there is room, advances the time, and checks all axes.
class Driven {
  public:
    Driven(std::vector<Move> moves, TrajectoryGeneratorSettings settings)
        : moves_(std::move(moves)), generator(machine(), {}, settings) {}

    /// Returns false when everything is executed.
    bool step(double seconds, bool early) {
        while (next_ < std::min(come, moves_.size()) && generator.has_room()) generator.push({moves_[next_++]});
        if (next_ == moves_.size() && !flushed_ && generator.has_room()) flushed_ = (generator.flush(), true);
        const NextMotion next = generator.next(early);
        if (next == NextMotion::nothing) return next_ < moves_.size() || !flushed_;
        if (next == NextMotion::dwell) {
            const double wait = std::min(seconds, generator.dwell_seconds());
            generator.advance_dwell(wait);
            now += wait;
            return true;
        }
        const double pass = std::min(seconds, generator.left());
        for (const double part : {0.005, 0.505}) poll(part * pass);
        generator.advance(pass);
        now += pass;
        return true;
    }
    void pass_time(double seconds) { now += seconds; }

    std::size_t come = static_cast<std::size_t>(-1);  ///< maximum number of available moves
    double now = 0, velocity = 0, accel = 0, jerk = 0,
           jump = 0;  ///< highest used share of each limit; jump: of the changes that the limits allow
    TrajectoryPoint last;

  private:
    void poll(double seconds) {
        const MachineLimits limits = machine();
        const TrajectoryPoint state = generator.at(seconds);
        const double gap = now + seconds - at_;
        for (std::size_t i = 0; i < limits.size(); ++i) {
            const AxisLimits& limit = limits[i];
            velocity = std::max(velocity, std::fabs(state.velocity[i]) / limit.max_velocity);
            accel = std::max(accel, std::fabs(state.accel[i]) / limit.max_accel);
            jerk = std::max(jerk, std::fabs(state.jerk[i]) / limit.max_jerk);
            jump = std::max(
                {jump, std::fabs(state.position[i] - last.position[i]) / (slack * limit.max_velocity * gap + 1e-5),
                 std::fabs(state.velocity[i] - last.velocity[i]) / (slack * limit.max_accel * gap + 1e-4),
                 std::fabs(state.accel[i] - last.accel[i]) / (slack * limit.max_jerk * gap + 1e-2)});
        }
        last = state;
        at_ = now + seconds;
    }

    std::vector<Move> moves_;
    std::size_t next_ = 0;
    bool flushed_ = false;
    double at_ = 0;

  public:
    TrajectoryGenerator generator;
};

inline void expect_limits(const Driven& driven) {
    EXPECT_LE(driven.velocity, slack);
    EXPECT_LE(driven.accel, slack);
    EXPECT_LE(driven.jerk, slack);
    EXPECT_LE(driven.jump, 1);
}

inline void expect_end(const Driven& driven, const Point& end) {
    for (std::size_t i = 0; i < end.size(); ++i) EXPECT_NEAR(driven.last.position[i], end[i], 1e-4);
}

inline Move long_line(double feed) {
    Move move = line_to({100});
    move.feed = feed;
    return move;
}

}  // namespace motionrack::control::trajectory_test
