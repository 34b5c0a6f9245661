// The slow reference solver: evaluates every motion of the correct form that reaches the target, and selects the
// fastest. Unlike the solver under test it does not scale the units; it integrates phases one after the other.
//
//   peak y <= accel: the acceleration rises to y;  y > accel: it is held at its limit for (y - accel)/jerk s
//   then it falls to a valley, on the low or the high branch, and rises to the final acceleration

#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/control/axis_profile/test/axis_profile_support.hpp>
#include <vector>

namespace motionrack::control::travel_test {

namespace {

constexpr double no_time = std::numeric_limits<double>::infinity();

struct Outcome {
    bool possible = false;
    double seconds = 0, position = 0;
};

struct State {
    double p, v, a, t;
    void go(double jerk, double dt) {
        p += dt * (v + dt * (a / 2 + dt * jerk / 6));
        v += dt * (a + dt * jerk / 2);
        a += dt * jerk;
        t += dt;
    }
};

class Search {
  public:
    explicit Search(const Task& task)
        : t_(task), j_(task.limits.jerk), a_(task.limits.accel), v_(task.limits.velocity) {}

    double min_duration(int steps) {
        double best = no_time;
        const double top = max_peak();
        best = std::min(best, cruising(top));
        // dense at both ends, where branches begin
        std::vector<double> peaks;
        for (int i = 0; i <= steps; ++i) {
            const double x = static_cast<double>(i) / steps;
            peaks.push_back(t_.from.accel + (top - t_.from.accel) * (x * x * (3 - 2 * x)));
        }
        for (const bool low : {false, true})
            for (int i = 0; i + 1 <= steps; ++i)
                best = std::min(
                    best, between(peaks[static_cast<std::size_t>(i)], peaks[static_cast<std::size_t>(i) + 1], low));
        return best;
    }

  private:
    State up_to(double peak) const {
        State s = {t_.from.position, t_.from.velocity, t_.from.accel, 0};
        s.go(j_, (std::min(peak, a_) - s.a) / j_);
        if (peak > a_) {
            s.a = a_;
            s.go(0, (peak - a_) / j_);
        }
        return s;
    }

    /// Returns the motion from a state to the end through a valley on the low or on the high branch.
    Outcome down(State s, bool low) const {
        // velocity gained by falling to q and rising to the final acceleration: (a^2 + end^2)/2 - q^2, over jerk
        const double square = 0.5 * (s.a * s.a + t_.to.accel * t_.to.accel) - j_ * (t_.to.velocity - s.v);
        if (!(square >= 0)) return {};
        double q = low ? -std::sqrt(square) : std::sqrt(square);
        double hold = 0;
        if (q < -a_) {
            hold = (square - a_ * a_) / j_ / a_;
            q = -a_;
        }
        if (q > s.a || q > t_.to.accel) return {};
        s.go(-j_, (s.a - q) / j_);
        s.go(0, hold);
        s.go(j_, (t_.to.accel - q) / j_);
        return {true, s.t, s.p};
    }

    /// Returns the position error of the motion with this peak on one branch; NaN if the branch has no such motion.
    double error(double peak, bool low, bool& possible, double& seconds) const {
        const Outcome out = down(up_to(peak), low);
        possible = out.possible;
        seconds = possible ? out.seconds : no_time;
        return possible ? out.position - t_.to.position : std::numeric_limits<double>::quiet_NaN();
    }

    double between(double from, double to, bool low) const {
        bool one, two;
        double seconds;
        double first = error(from, low, one, seconds);
        double second = error(to, low, two, seconds);
        if (!one && !two) return no_time;
        if (one != two) {  // start or end of the branch
            double in = one ? from : to, out = one ? to : from;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (in + out);
                bool possible;
                error(middle, low, possible, seconds);
                (possible ? in : out) = middle;
            }
            (one ? to : from) = in;
            first = error(from, low, one, seconds);
            second = error(to, low, two, seconds);
        }
        if (first == 0) return error(from, low, one, seconds), seconds;
        if (!(first * second <= 0)) return no_time;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (from + to);
            const double error_there = error(middle, low, one, seconds);
            ((error_there < 0) == (first < 0) ? from : to) = middle;
        }
        // rejects a change of sign at a gap of the branch: it is not a root
        const double left = std::fabs(error(from, low, one, seconds));
        return left <= 1e-9 * (std::fabs(first) + std::fabs(second)) ? seconds : no_time;
    }

    /// Returns the peak acceleration with which the velocity just reaches its maximum.
    double max_peak() const {
        const auto peak_velocity = [&](double peak) {
            const State s = up_to(peak);
            return s.v + (s.a > 0 ? 0.5 * s.a * s.a / j_ : 0);
        };
        double min = t_.from.accel, max = std::max(min, 0.0) + a_;
        while (peak_velocity(max) < v_) max *= 2;
        for (int i = 0; i < 70; ++i) {
            const double middle = 0.5 * (min + max);
            (peak_velocity(middle) < v_ ? min : max) = middle;
        }
        return min;
    }

    double cruising(double peak) const {
        State s = up_to(peak);
        if (s.a < 0) return no_time;
        s.go(-j_, s.a / j_);
        s.v = v_;
        s.a = 0;
        const Outcome rest = down(s, true);
        if (!rest.possible) return no_time;
        const double left = t_.to.position - rest.position;
        return left >= 0 ? rest.seconds + left / v_ : no_time;
    }

    Task t_;
    double j_, a_, v_;
};

Task mirrored(Task t) {
    for (KinematicState* s : {&t.from, &t.to}) *s = {-s->position, -s->velocity, -s->accel};
    return t;
}

/// Returns the seconds until a velocity that exceeds, or will exceed, `top` stays below it, if the acceleration falls
/// to `depth` and rises again. Returns infinity if the velocity then falls below -top.
double braked(State s, double depth, double top, const KinematicLimits& limits) {
    const double j = limits.jerk;
    const double straight = s.a * s.a + 2 * j * (s.v - top);
    if (!(straight >= 0)) return no_time;
    double entry = -std::sqrt(straight);
    if (entry >= depth) {
        s.go(-j, (s.a - entry) / j);
    } else {
        s.go(-j, (s.a - depth) / j);
        // holds this acceleration, then lets it rise so late that the velocity just stays above -top
        entry = std::max(depth, -2 * std::sqrt(j * top));
        const double rising = (depth * depth - entry * entry) / (2 * j);
        const double hold = (s.v - rising - top) / -depth;
        if (hold < 0) return no_time;
        s.go(0, hold);
        s.go(j, (entry - depth) / j);
    }
    return top - entry * entry / (2 * j) >= -top * (1 + 1e-12) ? s.t : no_time;
}

}  // namespace

double slowly_found_entry(const KinematicState& from, const KinematicLimits& limits) {
    const double j = limits.jerk, top = limits.velocity;
    State s = {0, from.velocity, from.accel, 0};
    if (std::fabs(s.a) > limits.accel) s.go(s.a > 0 ? -j : j, (std::fabs(s.a) - limits.accel) / j);
    const double last = s.v + s.a * std::fabs(s.a) / (2 * j);
    if (std::fabs(last) <= top && std::fabs(s.v) <= top) return s.t;
    const bool up = std::fabs(last) > top ? last < 0 : s.v < 0;
    if (up) s = {0, -s.v, -s.a, s.t};
    double best = no_time;
    double from_depth = std::min(s.a, 0.0), to_depth = -limits.accel;
    for (int round = 0; round < 3; ++round) {
        constexpr int steps = 1000;
        const double step = (to_depth - from_depth) / steps;
        double best_depth = from_depth;
        for (int i = 0; i <= steps; ++i) {
            const double depth = i == steps ? to_depth : from_depth + step * i;
            const double seconds = braked(s, depth, top, limits);
            if (seconds < best) {
                best = seconds;
                best_depth = depth;
            }
        }
        from_depth = std::min(from_depth, best_depth - step);
        to_depth = std::max(to_depth, best_depth + step);
    }
    return best;
}

double slowly_found_duration(const Task& task, int steps) {
    return std::min(Search(task).min_duration(steps), Search(mirrored(task)).min_duration(steps));
}

}  // namespace motionrack::control::travel_test
