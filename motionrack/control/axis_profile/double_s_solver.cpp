// Finds the double-S profile that reaches a position: depending on the holds a bracketed root of a quadratic or a
// quartic.
//
// A phase of the acceleration that rises from 0 and returns to 0 lasts u(x) = 2 sqrt(x) for a peak of sqrt(x) <= 1,
// and u(x) = 1 + x with a hold of x - 1 s. The reach is (start_foot + v) u(P^2)/2 +- (end_foot + v) u(s^2)/2 with
// v = end_foot + s^2, minus where s < 0. Its derivative with respect to the duration is the slope, which first falls
// and then rises with s: the reach may rise to a crest, fall and rise again. Solutions before the crest are faster.

#include <limits>
#include <motionrack/control/axis_profile/double_s_solver.hpp>
#include <motionrack/control/rest_profiles.hpp>
#include <utility>

namespace motionrack::control {

namespace {

constexpr double relative_rounding = std::numeric_limits<double>::epsilon();

double squared(double x) {
    return x * x;
}
double cube_third(double x) {
    return x * x * x * (1.0 / 3);
}

/// Returns the rounding error of a distance, at most 1e-12 of it. Errors of velocities and accelerations change the
/// time at the maximum acceleration `accel`, and so the distance by `sensitive` over `accel`.
double noise_of(double distance, double sensitive, double accel) {
    return 8 * relative_rounding * (distance + std::min(512 * distance, sensitive / accel));
}

/// A function value and its first two derivatives.
struct Jet {
    double value, first, second;
};
/// Finds the root of a function that is below 0 at `min` and above at `max`, with a single crossing. Uses Halley
/// steps from `guess`, and a bisection where a step would leave the bracket. `at(x)` returns the Jet of the function.
template <class Function>
double crossing(double min, double max, double guess, Function at) {
    double x = std::max(min, std::min(guess, max));
    for (int step = 0; step < 200; ++step) {
        const Jet f = at(x);
        (f.value < 0 ? min : max) = x;
        const double change = 2 * f.value * f.first / (2 * f.first * f.first - f.value * f.second);
        double next = x - change;
        // remaining error of a third-order step, once the second derivative term is small beside the first
        const bool near = std::fabs(change * f.second) < 1e-4 * f.first;
        if (near && std::fabs(change) <= 1e-6 * std::fabs(x)) return std::max(min, std::min(next, max));
        if (!(next > min && next < max)) {
            if (f.value == 0 || max - min <= 2 * relative_rounding * std::fabs(x)) return x;
            next = 0.5 * (min + max);
        }
        x = next;
    }
    return x;
}

}  // namespace

DirectVelocityChange direct_velocity_change(const BoundaryConditions& c) {
    // A single phase from one acceleration to the other changes the velocity by `ramp`.
    const double sum = c.start_accel + c.end_accel;
    const double ramp = 0.5 * sum * std::fabs(c.end_accel - c.start_accel);
    const double size =
        std::fabs(c.start_velocity) + std::fabs(c.end_velocity) + squared(c.start_accel) + squared(c.end_accel);
    const double more = c.change - ramp;
    const bool mirrored = std::fabs(more) <= 2 * relative_rounding * size ? sum < 0 : more < 0;
    const double sign = mirrored ? -1 : 1;
    const double a = sign * c.start_accel, b = sign * c.end_accel;
    const double height = sign * c.change + 0.5 * (a * a + b * b);
    const double min_peak = std::max(a, b);
    if (height > 1) return {mirrored, 1 - a, height - 1, 1 - b};
    const double peak = std::max(min_peak, std::sqrt(std::max(0.0, height)));
    return {mirrored, peak - a, 0, peak - b};
}

DoubleSSolver::DoubleSSolver(const BoundaryConditions& c, double top)
    : start_accel_(c.start_accel),
      end_accel_(c.end_accel),
      start_foot_(c.start_velocity - 0.5 * squared(c.start_accel)),
      end_foot_(c.end_velocity - 0.5 * squared(c.end_accel)),
      rise_(c.change + 0.5 * (c.start_accel - c.end_accel) * (c.start_accel + c.end_accel)),
      both_(start_foot_ + end_foot_),
      reach_(c.distance - (c.end_velocity * c.end_accel - cube_third(c.end_accel)) +
             (c.start_velocity * c.start_accel - cube_third(c.start_accel))),
      top_(top),
      min_s_(-c.end_accel) {
    if (rise_ < 0 && end_accel_ < 0) {
        swapped_ = true;
        min_s_ = std::sqrt(std::max(0.0, squared(end_accel_) + rise_));
        std::swap(start_foot_, end_foot_);
        rise_ = -rise_;
        floor_ = squared(end_accel_);
        return;
    }
    rise_ = std::max(0.0, rise_);
    if (start_accel_ > 0) {
        floor_ = squared(start_accel_);
        gap_ = std::sqrt(std::max(0.0, floor_ - rise_));
    }
}

double DoubleSSolver::reach_at(double s) const {
    const double low = s * s;
    const double high = high_at(s);
    const double up = high > 1 ? 0.5 * (1 + high) : std::sqrt(high);
    const double down = s > 1 ? 0.5 * (1 + low) : s;
    return (both_ + low) * up + (2 * end_foot_ + low) * down;
}

/// Returns a value with the sign of the slope.
double DoubleSSolver::flow_at(double s) const {
    const double high = rise_ + s * s;
    if (high > 1) return end_foot_ + s * (s + 0.5);
    return start_foot_ + high + 0.5 * s * std::sqrt(high);
}

/// Returns the s < 0 at which the reach has its crest; 1 if it has none.
double DoubleSSolver::first_crest() const {
    const double below = 0.25 - 4 * end_foot_;
    if (below > 0) {
        const double s = -0.25 - 0.5 * std::sqrt(below);
        if (rise_ + s * s > 1) return s;
    }
    const double under = 4 * squared(both_) - 3 * squared(rise_);
    if (!(both_ < 0 && under > 0)) return 1;
    const double fall = rise_ / std::sqrt(-2 * both_ + std::sqrt(under));
    return 0.5 * (fall - rise_ / fall);
}

bool DoubleSSolver::find(double slack, double sensitive) {
    double min_s = min_s_;
    const bool may_meet_gap = min_s < 0 && gap_ > 0;
    if (may_meet_gap) min_s = std::min(min_s, -gap_);
    const double before_gap = may_meet_gap ? -gap_ : 0;
    if (min_s < 0 && end_foot_ < 0.07 && flow_at(min_s) > 0) {
        const double crest = first_crest();
        if (crest > min_s && crest < before_gap) {
            if (reach_ <= reach_at(crest)) {
                find_between(min_s, crest);
                return true;
            }
            min_s = crest;
        }
    }
    if (!may_meet_gap) {
        find_above(min_s);
        return true;
    }
    // depth of the acceleration valley at both sides of the gap
    const double noise = slack + noise_of(std::fabs(reach_), sensitive, gap_);
    if (reach_ <= reach_at(-gap_) + noise) {
        find_between(min_s, -gap_);
        return true;
    }
    const double beyond = reach_ - reach_at(gap_);
    if (beyond < -noise) return false;
    if (beyond > noise) {
        find_above(gap_);
    } else {
        s_ = gap_;
    }
    return true;
}

void DoubleSSolver::find_beyond_gap() {
    find_above(gap_);
}

/// Solves for s above `min_s`: where the reach crosses the required one, or where the peak is the maximum velocity.
void DoubleSSolver::find_above(double min_s) {
    const double max_s = std::max(min_s, std::sqrt(std::max(0.0, top_ - end_foot_)));
    const double more = reach_ - reach_at(max_s);
    if (!(more < 0)) {
        s_ = max_s;
        cruise_ = more / top_;
        return;
    }
    find_between(min_s, max_s);
}

/// Solves for s between `min_s` and `max_s`, where the reach crosses the required one exactly once.
void DoubleSSolver::find_between(double min_s, double max_s) {
    if (max_s > 1 && (min_s >= 1 || reach_at(1) < reach_)) {
        s_ = std::clamp(with_both_holds(), std::max(1.0, min_s), max_s);
        return;
    }
    max_s = std::min(max_s, 1.0);
    if (!(rise_ < 1)) {
        s_ = with_hold(min_s, max_s);
        return;
    }
    // |s| at which the peak is exactly 1
    const double edge = std::sqrt(1 - rise_);
    const auto reach_at_edge = [&](double s) { return both_ + s * s + (2 * end_foot_ + s * s) * s; };
    if (max_s > edge && (min_s >= edge || reach_at_edge(edge) < reach_)) {
        s_ = with_hold(std::max(min_s, edge), max_s);
    } else if (min_s < -edge && (max_s <= -edge || reach_at_edge(-edge) >= reach_)) {
        s_ = with_hold(min_s, std::min(max_s, -edge));
    } else {
        s_ = without_hold(std::max(min_s, -edge), std::min(max_s, edge));
    }
}

/// Solves for s where both holds exist, the peak at acceleration 1 and the valley at -1: y^2 + 2 b y + c = 0 with
/// y = s^2.
double DoubleSSolver::with_both_holds() const {
    const double b = end_foot_ + 0.5;
    const double c = 0.5 * both_ * (1 + rise_) + end_foot_ - reach_;
    const double root = std::sqrt(std::max(0.0, b * b - c));
    const double y = b > 0 ? -c / (b + root) : root - b;
    return std::sqrt(std::max(0.0, y));
}

/// Solves for s where only the peak has a hold, at acceleration 1: u^4 - 2 u^3 + (1 + 2 end_foot) u^2 + c = 0 with
/// u = 1 + s.
double DoubleSSolver::with_hold(double min_s, double max_s) const {
    const double twice = 2 * end_foot_;
    const double c = both_ * (1 + rise_) - twice - 2 * reach_;
    const double middle = 0.5 * (min_s + max_s);
    const double guess_square = -c / (twice + middle * middle);
    const double guess = guess_square > 0 ? std::sqrt(guess_square) : 1 + middle;
    const double u = crossing(1 + min_s, 1 + max_s, guess, [&](double x) {
        const double s = x - 1;
        const double inner = s * s + twice;
        return Jet{x * x * inner + c, 2 * x * (inner + x * s), 2 * (inner + x * (4 * s + x))};
    });
    return u - 1;
}

/// Solves for s without holds: d^4 + 4 both d^2 - 4 reach d - rise^2 = 0 with d = P + s, the duration of the phases
/// with jerk -1.
double DoubleSSolver::without_hold(double min_s, double max_s) const {
    const auto fall_at = [&](double s) {
        const double peak = std::sqrt(rise_ + s * s);
        return s < 0 ? (peak - s > 0 ? rise_ / (peak - s) : 0) : peak + s;
    };
    const double low = fall_at(min_s), high = fall_at(max_s);
    const double b = 4 * both_, c = 4 * reach_, rise_square = rise_ * rise_;
    double guess = 0;
    if (both_ > 0 && reach_ > 0) {
        // bounds of the root by omitting one of the terms
        const double slow = (reach_ + std::sqrt(reach_ * reach_ + both_ * rise_square)) / (2 * both_);
        guess = std::min(slow, cube_root(c) + std::sqrt(rise_));
    } else {
        guess = std::sqrt(std::max(0.0, -2 * both_) + std::sqrt(4 * both_ * both_ + rise_square));
        if (reach_ > 0) guess += cube_root(c);
    }
    const double d = crossing(low, high, guess, [&](double x) {
        const double squared = x * x;
        return Jet{squared * (squared + b) - c * x - rise_square, x * (4 * squared + 2 * b) - c, 12 * squared + 2 * b};
    });
    return d > 0 ? 0.5 * (d - rise_ / d) : 0;
}

DoubleSPhases DoubleSSolver::phases() const {
    const double low = s_ * s_;
    const double high = high_at(s_);
    double peak = high > 1 ? 1 : std::sqrt(high);
    double valley = s_ > 1 ? 1 : s_;
    double hold_peak = std::max(0.0, high - 1), hold_valley = s_ > 1 ? low - 1 : 0;
    if (swapped_) {
        std::swap(peak, valley);
        std::swap(hold_peak, hold_valley);
    }
    peak = std::max(peak, start_accel_);  // true except for rounding
    valley = std::max(valley, -end_accel_);
    const bool cruises = cruise_ > 0;
    return {peak - start_accel_,
            hold_peak,
            cruises ? peak : std::max(0.0, peak + valley),
            cruise_,
            cruises ? valley : 0,
            hold_valley,
            valley + end_accel_};
}

TimeOptimalSolution solve_time_optimal(const BoundaryConditions& given, double top, double slack) {
    const DirectVelocityChange direct = direct_velocity_change(given);
    const BoundaryConditions course = direct.mirrored ? given.mirrored() : given;
    // distance of the direct change, phase by phase from both ends
    const double a = course.start_accel, b = course.end_accel;
    const double first = direct.rise * (course.start_velocity + direct.rise * (0.5 * a + direct.rise * (1.0 / 6)));
    const double last = direct.fall * (course.end_velocity - direct.fall * (0.5 * b + direct.fall * (1.0 / 6)));
    const double velocity = course.start_velocity + direct.rise * (a + 0.5 * direct.rise);
    const double held = direct.hold * (velocity + 0.5 * direct.hold * (a + direct.rise));
    const double more = course.distance - (first + held + last);
    const double parts = std::fabs(first) + std::fabs(held) + std::fabs(last);
    const double velocities = std::fabs(course.start_velocity) + std::fabs(course.end_velocity);
    const double sensitive = velocities * velocities + (velocities + a * a + b * b) * (std::fabs(a) + std::fabs(b));
    const double max_accel = std::max(a + direct.rise, std::max(std::fabs(a), std::fabs(b)));
    const double noise = slack + noise_of(parts, sensitive, max_accel);
    if (std::fabs(more) <= noise) return {direct.mirrored, false, {direct.rise, direct.hold, direct.fall, 0, 0, 0, 0}};
    bool backwards = more < 0;
    DoubleSSolver solver(backwards ? course.backwards() : course, top);
    if (solver.find(slack, sensitive)) return {direct.mirrored, backwards, solver.phases()};
    backwards = !backwards;
    DoubleSSolver others(backwards ? course.backwards() : course, top);
    others.find_beyond_gap();
    return {direct.mirrored, backwards, others.phases()};
}

}  // namespace motionrack::control
