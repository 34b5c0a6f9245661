// Shared by the tests of the path builder: programs of all kinds from a seed, and the whole curve of a program.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <random>
#include <vector>

namespace motionrack::control::curve_test {

inline constexpr double pulses = 1000;
inline constexpr double half_pulse = 0.5 / pulses;

inline MachineLimits machine() {
    MachineLimits limits;
    for (AxisLimits& axis : limits) axis = {true, -1e9, 1e9, 200, 2000, 40'000, 1, pulses};
    return limits;
}

inline Move line_to(const Point& end, double tolerance_mm = 0.01) {
    Move move;
    move.kind = MoveKind::feed;
    move.path = PathControl::continuous;
    move.tolerance_mm = tolerance_mm;
    move.feed = 100;
    move.end = end;
    return move;
}

/// Sets a feed rate (1 mm/s) at which the motion passes corners without a stop.
inline Move slow(Move move) {
    move.feed = 1;
    return move;
}

/// Makes an arc in the XY plane; `sweep` in rad, > 0 to the left; starts at `at` in the direction of `heading`.
inline Move arc_from(const Point& at, double heading, double radius, double sweep, double tolerance_mm = 0.01) {
    Move move = line_to(at, tolerance_mm);
    move.kind = MoveKind::arc;
    const double side = sweep > 0 ? radius : -radius;
    const SinCos in = sin_cos(heading), out = sin_cos(heading + sweep);
    move.centre_first = at[0] - side * in.sin;
    move.centre_second = at[1] + side * in.cos;
    move.end[0] = move.centre_first + side * out.sin;
    move.end[1] = move.centre_second - side * out.cos;
    const int turns = 1 + static_cast<int>((std::fabs(sweep) - 1e-9) / (2 * pi));
    move.turns = sweep > 0 ? turns : -turns;
    return move;
}

/// Numbers the lines of the moves 1, 2, ...
inline std::vector<Move> numbered(std::vector<Move> moves) {
    for (std::size_t i = 0; i < moves.size(); ++i) moves[i].line = static_cast<std::int32_t>(i + 1);
    return moves;
}

inline std::vector<PathElement> curve_of(const std::vector<Move>& moves, const MachineLimits& limits = machine()) {
    PathBuilder builder(limits, Point{});
    std::vector<PathElement> out;
    PathElement item;
    for (const Move& move : moves) {
        while (!builder.has_room() && builder.pull(item)) out.push_back(item);
        builder.push(move);
    }
    while (!builder.has_room() && builder.pull(item)) out.push_back(item);
    builder.flush();
    while (builder.pull(item)) out.push_back(item);
    return out;
}

inline std::vector<Geometry> paths_of(const std::vector<Move>& moves, Point at = {}) {
    std::vector<Geometry> paths;
    for (const Move& move : moves) {
        paths.push_back(geometry_of(move, at));
        at = paths.back().end;
    }
    return paths;
}

inline std::vector<CubicSegment> pieces_of(const std::vector<PathElement>& items) {
    std::vector<CubicSegment> out;
    for (const PathElement& item : items)
        if (!item.rest) out.push_back(item.piece);
    return out;
}

inline int rests_in(const std::vector<PathElement>& items) {
    return static_cast<int>(
        std::count_if(items.begin(), items.end(), [](const PathElement& item) { return item.rest; }));
}

inline double xyz_size(const Point& p) {
    return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

/// Makes programs with all elements: chords on smooth curves, zigzags, corners, arcs, helices, spirals, rotary axes,
/// dwells, and moves too short to be noticed; with all path controls and feed rates.
class ProgramMaker {
  public:
    explicit ProgramMaker(std::uint64_t seed) : random_(seed) {}

    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    int one_of(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
    /// Returns a size from a logarithmic distribution.
    double size_between(double low, double high) { return low * std::exp(between(0, std::log(high / low))); }

    std::vector<Move> program(int sections) {
        std::vector<Move> moves;
        for (int i = 0; i < sections; ++i) {
            mode_ = line_to(at_, size_between(1e-4, 0.5));
            mode_.path = static_cast<PathControl>(one_of(8) == 0 ? 1 : one_of(3) == 0 ? 0 : 2);
            mode_.feed = size_between(1, 1000);
            if (one_of(6) == 0) mode_.feed_mode = FeedMode::inverse_time;
            if (one_of(6) == 0) mode_.kind = MoveKind::rapid, mode_.rapid_override = one_of(2) == 0 ? 1 : 0.5;
            section(moves);
        }
        return numbered(moves);
    }

  private:
    void add(std::vector<Move>& moves, Move move) {
        if (one_of(20) == 0) move.feed *= between(0.5, 2);
        at_ = move.end;
        moves.push_back(move);
    }

    void go(std::vector<Move>& moves, double length) {
        Move move = mode_;
        const SinCos along = sin_cos(heading_);
        move.end = at_;
        move.end[0] += length * along.cos;
        move.end[1] += length * along.sin;
        move.end[2] += climb_ * length;
        move.end[4] += turn_ * length;
        add(moves, move);
    }

    void section(std::vector<Move>& moves) {
        const int count = 1 + one_of(30);
        const double step = size_between(0.01, 30);
        climb_ = one_of(3) == 0 ? between(-1, 1) : 0;
        turn_ = one_of(4) == 0 ? between(-3, 3) : 0;
        const int kind = one_of(9);
        if (kind == 0) {  // chords on a curve
            const double curvature = between(-0.3, 0.3);
            for (int i = 0; i < count; ++i) heading_ += curvature * step * 0.1, go(moves, step * 0.1);
        } else if (kind == 1) {  // zigzag
            const double angle = between(0, 2.8);
            for (int i = 0; i < count; ++i) heading_ += i % 2 == 0 ? angle : -angle, go(moves, step);
        } else if (kind == 2) {
            for (int i = 0; i < count; ++i) heading_ += between(-3.2, 3.2), go(moves, size_between(0.01, step * 2));
        } else if (kind <= 5) {
            arcs(moves, 1 + one_of(6), step, kind == 3);
        } else if (kind == 6) {  // only rotary axes
            for (int i = 0; i < count; ++i) {
                Move move = mode_;
                if (move.kind == MoveKind::arc) move.kind = MoveKind::feed;
                move.end = at_;
                move.end[3] += between(-1, 1) * step;
                move.end[5] += step;
                add(moves, move);
            }
        } else if (kind == 7) {
            Move dwell = mode_;
            dwell.kind = MoveKind::dwell;
            dwell.seconds = 0.1;
            dwell.end = at_;
            moves.push_back(dwell);
        } else {  // chords with noise, and moves that are too short to be noticed
            for (int i = 0; i < count; ++i) {
                go(moves, one_of(3) == 0 ? size_between(1e-10, 1e-5) : step * 0.01);
                heading_ += between(-0.02, 0.02);
            }
        }
    }

    void arcs(std::vector<Move>& moves, int count, double radius, bool tangent) {
        for (int i = 0; i < count; ++i) {
            if (!tangent && one_of(2) == 0) heading_ += between(-1.5, 1.5);
            const double sweep =
                (one_of(2) == 0 ? 1 : -1) * (one_of(5) == 0 ? size_between(1e-4, 0.3) : between(0.05, 14));
            Move arc = arc_from(at_, heading_, radius * between(0.3, 2), sweep);
            Move move = mode_;
            move.kind = MoveKind::arc;
            move.centre_first = arc.centre_first;
            move.centre_second = arc.centre_second;
            move.turns = arc.turns;
            move.end = arc.end;
            if (climb_ != 0) move.end[2] += climb_ * std::fabs(sweep) * radius * 0.3;
            if (turn_ != 0) move.end[5] += turn_ * std::fabs(sweep) * 5;
            if (one_of(6) == 0 && std::fabs(sweep) > 0.5) {  // a spiral
                const double grown = 1 + between(-0.002, 0.002);
                move.end[0] = move.centre_first + grown * (move.end[0] - move.centre_first);
                move.end[1] = move.centre_second + grown * (move.end[1] - move.centre_second);
            }
            heading_ += sweep;
            add(moves, move);
            if (one_of(3) == 0) go(moves, size_between(0.05, 10));
        }
    }

    std::mt19937_64 random_;
    Move mode_;
    Point at_ = {};
    double heading_ = 0, climb_ = 0, turn_ = 0;
};

}  // namespace motionrack::control::curve_test
