// The angle of an arc is proportional to its completed share; u of a spiral is an integral that is at least its length.

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/path/arc_curve.hpp>

namespace motionrack::control {

ArcCurve::ArcCurve(const Geometry& arc)
    : first_(arc.first),
      second_(arc.second),
      centre_first_(arc.centre_first),
      centre_second_(arc.centre_second),
      from_first_(arc.start[arc.first] - arc.centre_first),
      from_second_(arc.start[arc.second] - arc.centre_second),
      sweep_(arc.sweep),
      growth_(arc.radius_growth),
      start_(arc.start) {
    for (int i = 0; i < axis_count; ++i) change_[i] = arc.end[i] - arc.start[i];
    const double radius_in = arc.radius / (1 + 0.5 * growth_);
    const double radius_out = radius_in * (1 + growth_);
    const double along = change_[arc.third];
    const double outwards = radius_in * growth_;
    const double straight = along * along + outwards * outwards;
    rate_in_ = std::sqrt(straight + radius_in * radius_in * sweep_ * sweep_);
    rate_out_ = std::sqrt(straight + radius_out * radius_out * sweep_ * sweep_);
    const double min_rate = std::min(rate_in_, rate_out_);
    turn_rate_ = std::fabs(sweep_) / min_rate;
    max_curvature_ = std::max(radius_in, radius_out) * turn_rate_ * turn_rate_;
    for (int i = 3; i < axis_count; ++i) rotary_rate_ = std::max(rotary_rate_, std::fabs(change_[i]) / min_rate);
}

ArcCurvePoint ArcCurve::at(double u) const {
    const double slope = rate_out_ - rate_in_;
    const double part =
        slope == 0 ? u / rate_in_ : 2 * u / (rate_in_ + std::sqrt(std::max(0.0, rate_in_ * rate_in_ + 2 * slope * u)));
    const double by_u = 1 / (rate_in_ + slope * part);  // derivatives of `part` with respect to u
    const double by_u2 = -slope * by_u * by_u * by_u;
    const double by_u3 = 3 * by_u2 * by_u2 / by_u;
    ArcCurvePoint out;
    for (int i = 0; i < axis_count; ++i) {
        out.at[i] = start_[i] + change_[i] * part;
        out.tangent[i] = change_[i] * by_u;
        out.curvature[i] = change_[i] * by_u2;
        out.curvature_rate[i] = change_[i] * by_u3;
    }
    const SinCos turned = sin_cos(sweep_ * part);
    const double x = from_first_ * turned.cos - from_second_ * turned.sin;
    const double y = from_first_ * turned.sin + from_second_ * turned.cos;
    const double size = 1 + growth_ * part;
    // derivative in the plane with respect to `part`: outwards along (x, y), around along (-y, x)
    const double out1 = growth_, around1 = size * sweep_;
    const double out2 = -size * sweep_ * sweep_, around2 = 2 * growth_ * sweep_;
    const double out3 = -3 * growth_ * sweep_ * sweep_, around3 = -size * sweep_ * sweep_ * sweep_;
    const auto plane = [&](std::size_t axis, double centre, double outwards, double around) {
        const double first = out1 * outwards + around1 * around;
        const double second = out2 * outwards + around2 * around;
        const double third = out3 * outwards + around3 * around;
        out.at[axis] = centre + size * outwards;
        out.tangent[axis] = first * by_u;
        out.curvature[axis] = second * by_u * by_u + first * by_u2;
        out.curvature_rate[axis] = third * by_u * by_u * by_u + 3 * second * by_u * by_u2 + first * by_u3;
    };
    plane(first_, centre_first_, x, -y);
    plane(second_, centre_second_, y, x);
    return out;
}

}  // namespace motionrack::control
