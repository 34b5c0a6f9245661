// The slow reference for durations: minimum duration of a curve with velocity and acceleration limits of the axes and
// any jerk.
//
// Fine steps over u, each with constant acceleration along u. A step from one square of velocity to another is checked
// for every axis at both ends of the step. The maximum squares are found by bisection.
#pragma once

#include <algorithm>
#include <cmath>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>
#include <span>
#include <vector>

namespace motionrack::control::trajectory_test {

/// Step of the curve with the demands on each axis.
struct OracleStep {
    double length = 0;
    Point tangent_in = {}, bend_in = {}, tangent_out = {}, bend_out = {};
};

class Oracle {
  public:
    /// Divides each segment into at least `of_piece` steps, and the curve into about `of_curve` steps.
    Oracle(std::span<const CubicSegment> curve, const MachineLimits& limits, int of_piece = 20, int of_curve = 4000)
        : limits_(limits) {
        if (curve.empty()) return;
        const double whole = curve.back().begin + curve.back().length;
        caps_.push_back(0);
        for (const CubicSegment& piece : curve) {
            const int count = of_piece + static_cast<int>(of_curve * std::min(1.0, piece.length / whole));
            for (int i = 0; i < count; ++i) {
                const double begin = piece.length * i / count, end = piece.length * (i + 1) / count;
                steps_.push_back({piece.length / count, tangent_on(piece, begin), curvature_on(piece, begin),
                                  tangent_on(piece, end), curvature_on(piece, end)});
                caps_.back() = std::min(caps_.back(), cap(steps_.back().tangent_in, piece.feed));
                caps_.push_back(cap(steps_.back().tangent_out, piece.feed));
            }
        }
        caps_.back() = 0;
    }

    /// Returns the duration from standstill to standstill.
    double seconds() const {
        std::vector<double> max_squares = caps_;
        for (std::size_t i = steps_.size(); i-- > 0;)
            max_squares[i] = find_max(caps_[i], [&](double square) {
                return compute_reachable_velocities(steps_[i], square, max_squares[i + 1]).some();
            });
        double seconds = 0, square = 0;
        for (std::size_t i = 0; i < steps_.size(); ++i) {
            const double next = std::clamp(compute_reachable_velocities(steps_[i], square, max_squares[i + 1]).high,
                                           0.0, max_squares[i + 1]);
            seconds += 2 * steps_[i].length / (std::sqrt(square) + std::sqrt(next));
            square = next;
        }
        return seconds;
    }

  private:
    struct Reach {
        double low = 0, high = 0;
        bool some() const { return low <= high; }
    };

    double cap(const Point& tangent, double feed) const {
        double velocity = std::min(feed, 1e100);
        for (std::size_t i = 0; i < tangent.size(); ++i)
            if (tangent[i] != 0) velocity = std::min(velocity, limits_[i].max_velocity / std::fabs(tangent[i]));
        return velocity * velocity;
    }

    /// Returns the squares at the end of a step that are reachable from one at its start.
    Reach compute_reachable_velocities(const OracleStep& step, double square, double max_square) const {
        Reach out{0, max_square};
        const double per_accel = 2 * step.length;
        for (std::size_t i = 0; i < limits_.size(); ++i) {
            // start: |tangent a + curvature w0| <= accel, where a = (w1 - w0) / (2 length)
            within(out, step.tangent_in[i] / per_accel,
                   step.bend_in[i] * square - step.tangent_in[i] / per_accel * square, limits_[i].max_accel);
            // end: |tangent a + curvature w1| <= accel
            within(out, step.tangent_out[i] / per_accel + step.bend_out[i], -step.tangent_out[i] / per_accel * square,
                   limits_[i].max_accel);
        }
        return out;
    }

    /// Restricts w to |by w + with| <= max.
    static void within(Reach& w, double by, double with, double max) {
        if (by == 0) {
            if (std::fabs(with) > max) w.high = -1;
            return;
        }
        const double a = (-max - with) / by, b = (max - with) / by;
        w.low = std::max(w.low, std::min(a, b));
        w.high = std::min(w.high, std::max(a, b));
    }

    template <class Can>
    static double find_max(double cap, Can can) {
        if (can(cap)) return cap;
        double low = 0, high = cap;
        while (high - low > 1e-12 * high && high > 1e-290) {
            // Bisects by magnitude first: caps may be far too large.
            const double middle = low > 0 && high < 4 * low ? 0.5 * (low + high)
                                  : low > 0                 ? std::sqrt(low) * std::sqrt(high)
                                                            : high * 1e-3;
            (can(middle) ? low : high) = middle;
        }
        return low;
    }

    MachineLimits limits_;
    std::vector<OracleStep> steps_;
    std::vector<double> caps_;
};

/// Returns the minimum duration, s.
inline double time_optimal_s(std::span<const CubicSegment> curve, const MachineLimits& limits, int of_piece = 20,
                             int of_curve = 4000) {
    return Oracle(curve, limits, of_piece, of_curve).seconds();
}

}  // namespace motionrack::control::trajectory_test
