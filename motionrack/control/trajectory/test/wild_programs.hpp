// Random programs with any sequence of moves, on machines whose axes differ by up to a factor of a million; each from a
// seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>
#include <random>
#include <string>
#include <vector>

namespace motionrack::control::trajectory_test {

struct WildProgram {
    MachineLimits limits;
    Point start = {};
    std::vector<Move> moves;
};

class WildMaker {
  public:
    explicit WildMaker(std::uint64_t seed) : random_(seed) {}

    WildProgram program() {
        WildProgram out;
        make_limits(out.limits);
        if (one_of(3) == 0)
            for (double& x : at_) x = between(-100, 100);
        out.start = at_;
        const int sections = 1 + one_of(6);
        for (int i = 0; i < sections; ++i) {
            make_mode();
            const int count = 1 + one_of(one_of(4) == 0 ? 40 : 8);
            const int kind = one_of(10);
            size_ = size_between(1e-9, 100);
            for (int k = 0; k < count; ++k) add(out.moves, kind);
        }
        for (std::size_t i = 0; i < out.moves.size(); ++i) out.moves[i].line = static_cast<std::int32_t>(i + 1);
        return out;
    }

  private:
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    int one_of(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
    double size_between(double low, double high) { return low * std::exp(between(0, std::log(high / low))); }

    void make_limits(MachineLimits& limits) {
        // The limits of the axes are equal, or differ by a factor of up to 100 or 1e6.
        const double apart = one_of(3) == 0 ? 1 : one_of(2) == 0 ? 10 : 1000;
        const bool no_jerk = one_of(10) == 0;
        const double pulses = size_between(100, 1e5);
        for (AxisLimits& axis : limits) {
            axis = {true, -1e9, 1e9, 100, 1000, 20'000, 1, pulses};
            axis.max_velocity *= size_between(1 / apart, apart);
            axis.max_accel *= size_between(1 / apart, apart);
            axis.max_jerk *= no_jerk ? 0 : size_between(1 / apart, apart);
        }
    }

    void make_mode() {
        mode_ = Move{};
        mode_.kind = one_of(6) == 0 ? MoveKind::rapid : MoveKind::feed;
        mode_.rapid_override = one_of(2) == 0 ? 1 : between(0.01, 1);
        mode_.path = static_cast<PathControl>(one_of(5) < 3 ? 2 : one_of(2));
        mode_.tolerance_mm = one_of(8) == 0 ? 0 : size_between(1e-5, 2);
        mode_.feed_mode = one_of(5) == 0 ? FeedMode::inverse_time : FeedMode::units_per_second;
        mode_.feed = one_of(2) == 0 ? size_between(1e-6, 1e6) : size_between(1, 300);
        climb_ = one_of(3) == 0 ? between(-1, 1) : 0;
        turn_ = one_of(4) == 0 ? size_between(1e-3, 30) : 0;
    }

    void add(std::vector<Move>& moves, int kind) {
        if (one_of(25) == 0) make_mode();
        const double heading_before = heading_;
        switch (kind) {
            case 0:
                heading_ += between(-pi, pi);
                line(moves, size_between(1e-9, 100));
                break;
            case 1:
                heading_ += between(-0.1, 0.1);
                line(moves, size_);
                break;  // chords
            case 2:
                heading_ += moves.size() % 2 == 0 ? 2.0 : -2.0;
                line(moves, size_);
                break;  // zigzag
            case 3:
                heading_ += pi;
                line(moves, size_ * between(0.5, 1));
                break;  // back and forth
            case 4:
                heading_ += one_of(2) == 0 ? 0 : pi / 2;
                line(moves, size_between(1e-6, 30));
                break;  // axis by axis
            case 5:
            case 6:
                if (kind == 6) heading_ += between(-2, 2);
                arc(moves);
                break;
            case 7:
                rotary(moves);
                break;
            case 8:
                one_of(3) == 0 ? dwell(moves) : line(moves, size_);
                break;
            default:
                one_of(2) == 0 ? arc(moves) : line(moves, size_between(1e-3, 50));
                break;  // collinear
        }
        if (!std::isfinite(heading_)) heading_ = heading_before;
    }

    void line(std::vector<Move>& moves, double length) {
        Move move = mode_;
        const SinCos along = sin_cos(heading_);
        at_[0] += length * along.cos;
        at_[1] += length * along.sin;
        at_[2] += climb_ * length;
        at_[4] += turn_ * length;
        move.end = at_;
        moves.push_back(move);
    }

    /// Adds an arc in any plane; the rotary axes and the third one may move with it.
    void arc(std::vector<Move>& moves) {
        Move move = mode_;
        const std::size_t first = one_of(4) == 0 ? static_cast<std::size_t>(one_of(3)) : 0, second = (first + 1) % 3,
                          third = (first + 2) % 3;
        move.kind = MoveKind::arc;
        move.first = static_cast<std::uint8_t>(first);
        move.second = static_cast<std::uint8_t>(second);
        const double radius = one_of(2) == 0 ? size_between(1e-4, 100) : size_between(0.1, 20);
        const double sweep = (one_of(2) == 0 ? 1 : -1) *
                             (one_of(4) == 0 ? size_between(1e-5, 0.1) : between(0.05, one_of(4) == 0 ? 20 : 6));
        const double side = sweep > 0 ? radius : -radius;
        const SinCos in = sin_cos(heading_), out = sin_cos(heading_ + sweep);
        move.centre_first = at_[first] - side * in.sin;
        move.centre_second = at_[second] + side * in.cos;
        at_[first] = move.centre_first + side * out.sin;
        at_[second] = move.centre_second - side * out.cos;
        if (climb_ != 0) at_[third] += climb_ * radius * std::fabs(sweep);
        if (turn_ != 0) at_[5] += turn_ * std::fabs(sweep);
        const int turns = 1 + static_cast<int>((std::fabs(sweep) - 1e-9) / (2 * pi));
        move.turns = sweep > 0 ? turns : -turns;
        move.end = at_;
        heading_ += sweep;
        moves.push_back(move);
    }

    void rotary(std::vector<Move>& moves) {
        Move move = mode_;
        at_[3] += between(-1, 1) * size_;
        at_[5] += one_of(3) == 0 ? -size_ : size_;
        move.end = at_;
        moves.push_back(move);
    }

    void dwell(std::vector<Move>& moves) {
        Move move = mode_;
        move.kind = MoveKind::dwell;
        move.seconds = one_of(3) == 0 ? 0 : size_between(1e-6, 10);
        move.end = at_;
        moves.push_back(move);
    }

    std::mt19937_64 random_;
    Move mode_;
    Point at_ = {};
    double heading_ = 0, climb_ = 0, turn_ = 0, size_ = 1;
};

}  // namespace motionrack::control::trajectory_test
