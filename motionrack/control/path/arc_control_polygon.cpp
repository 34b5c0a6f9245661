// Computes the knots first, then the corners: each is the point of the arc at the mean of its knots, moved outwards to
// compensate for the blend.

#include <algorithm>
#include <cmath>
#include <motionrack/control/path/arc_control_polygon.hpp>

namespace motionrack::control {
namespace {

/// Maximum angle of a knot interval (rad).
constexpr double widest_angle = 0.2;

/// Maximum number of consecutive doubled intervals.
constexpr int max_doubled = 60;

/// Returns the sum of the first `count` doubled intervals, starting with 1.
double doubled(std::int64_t count) {
    return static_cast<double>((std::uint64_t{1} << count) - 1);
}

}  // namespace

double inner_step(const ArcCurve& arc, double tolerance) {
    const double rate = arc.turn_rate();
    // error: curvature * rate^2 * step^4 / 72
    const double square = std::sqrt(72 * tolerance / arc.max_curvature()) / rate;
    return std::min(widest_angle / rate, std::sqrt(square));
}

ArcControlPolygon::ArcControlPolygon(const ArcCurve& arc, double step_in, double step_out, double inner) : arc_(arc) {
    const double length = arc.length();
    double in = std::min(step_in, inner), out = std::min(step_out, inner);
    constexpr double beside = 1 + step_after_junction;
    if (in == 0 || out == 0) {
        in = std::min(in, length / beside);
        out = std::min(out, length / beside);
    }
    while ((in + out) * beside > length && in > 2 * out) in *= 0.5;
    while ((in + out) * beside > length && out > 2 * in) out *= 0.5;
    if ((in + out) * beside > length * (1 + 1e-12)) {
        step_ = std::min(in, out);
        const double steps = std::max(1.0, std::ceil(length / step_ - 2 * step_after_junction - 1e-9));
        step_ = step_in_ = step_out_ = length / (steps + 2 * step_after_junction);
        corners_ = static_cast<std::int64_t>(steps) + 1;
    } else {
        rising_ = in > 0, falling_ = out > 0;
        double last_in = in, last_out = out;
        double total = (in + out) * beside;
        for (;;) {
            const bool at_start = falling_ == 0 || (rising_ > 0 && last_in <= last_out);
            double& last = at_start ? last_in : last_out;
            int& count = at_start ? rising_ : falling_;
            if (last == 0 || 2 * last > inner || total + 2 * last > length || count == max_doubled) break;
            last *= 2;
            total += last;
            ++count;
        }
        const double widest = std::max(last_in, last_out);
        step_ = widest > 0 ? std::min(inner, 2 * widest) : inner;
        const double steps = std::max(0.0, std::ceil((length - total) / step_ - 1e-9));
        const double scale = length / (total + steps * step_);
        step_ *= scale, step_in_ = in * scale, step_out_ = out * scale;
        corners_ = rising_ + falling_ + static_cast<std::int64_t>(steps) + 1;
    }
    first_ = step_after_junction * step_in_;
    last_ = length - step_after_junction * step_out_;

    // The first and the last corner are on the tangents, at the ends of their edges.
    const auto along = [](const Point& delta, const Point& tangent) {
        return (delta[0] * tangent[0] + delta[1] * tangent[1] + delta[2] * tangent[2]) /
               (tangent[0] * tangent[0] + tangent[1] * tangent[1] + tangent[2] * tangent[2]);
    };
    const auto more = [&](std::int64_t i, double end) {
        const double knots[3] = {knot(i - 1), knot(i), knot(i + 1)};
        const double u = (knots[0] + knots[1] + knots[2]) / 3;
        const ArcCurvePoint from = arc_.at(end);
        Point delta = control(u, knots);
        for (int axis = 0; axis < axis_count; ++axis) delta[axis] -= from.at[axis];
        return std::fabs(along(delta, from.tangent)) - std::fabs(u - end);
    };
    more_in_ = in > 0 ? more(0, 0) : 0;
    more_out_ = out > 0 ? more(corners_ - 1, length) : 0;
}

double ArcControlPolygon::knot(std::int64_t i) const {
    if (i < 0) return -step_before_junction * step_in_;
    if (i >= corners_) return arc_.length() + step_before_junction * step_out_;
    const std::int64_t from_end = corners_ - 1 - i;
    if (i <= rising_) return first_ + step_in_ * doubled(i);
    if (from_end <= falling_) return last_ - step_out_ * doubled(from_end);
    return first_ + step_in_ * doubled(rising_) + static_cast<double>(i - rising_) * step_;
}

/// Returns the control point of a cubic B-spline that follows the arc: exact for cubics.
Point ArcControlPolygon::control(double u, const double (&knots)[3]) const {
    const double a = knots[0] - u, b = knots[1] - u, c = knots[2] - u;
    const double second = -(a * a + b * b + c * c) / 12;
    const double third = a * b * c / 6;
    const ArcCurvePoint on = arc_.at(u);
    Point out;
    for (int i = 0; i < axis_count; ++i) out[i] = on.at[i] + second * on.curvature[i] + third * on.curvature_rate[i];
    return out;
}

ArcControlPoint ArcControlPolygon::next() {
    const std::int64_t i = next_++;
    const double knots[3] = {knot(i - 1), knot(i), knot(i + 1)};
    const double u = (knots[0] + knots[1] + knots[2]) / 3;
    ArcControlPoint out = {u + more_in_, knots[0] + more_in_, knots[1] + more_in_, knots[2] + more_in_,
                           {},           i + 1 == corners_};
    if (i > 0 && !out.last) {
        out.at = control(u, knots);
        return out;
    }
    const ArcCurvePoint end = arc_.at(i == 0 ? 0 : arc_.length());
    const double delta = i == 0 ? out.u : out.u - length();
    for (int axis = 0; axis < axis_count; ++axis) out.at[axis] = end.at[axis] + end.tangent[axis] * delta;
    return out;
}

}  // namespace motionrack::control
