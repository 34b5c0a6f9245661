// Bezier curves and their biarcs. Uses only + - * / and square roots, so the result is the same on every platform.
#include <algorithm>
#include <cmath>
#include <motionrack/control/gcode/biarc_approximator.hpp>
#include <motionrack/control/gcode/plane_point.hpp>

namespace motionrack::control::gcode {

namespace {

/// Number of steps of the curve parameter; a part of the curve is at least one step long.
constexpr std::uint32_t finest = 1u << 30;

/// Tolerance at the samples of the curve. Between them the deviation is hardly larger, so half of the maximum
/// is a sufficient margin.
constexpr double tolerance = spline_tolerance_mm / 2;
constexpr int samples = 16;

/// Flatter arcs (mm: height over the chord) and arcs with a larger radius become lines.
constexpr double flat_mm = 1e-6;
constexpr double largest_radius_mm = 1e6;

/// A vector shorter than this share of the control polygon has no direction.
constexpr double no_direction = 1e-12;

PlanePoint interpolated(PlanePoint a, PlanePoint b, double t) {
    return a * (1 - t) + b * t;
}
double polygon_length(const std::array<PlanePoint, 4>& p) {
    return length(p[1] - p[0]) + length(p[2] - p[1]) + length(p[3] - p[2]);
}

/// Computes radius and centre of the arc that starts at `at` along `tangent` and passes through `at + chord`. The
/// radius is > 0 to the left of `tangent`, and 0 for a line.
double arc_through(PlanePoint at, PlanePoint tangent, PlanePoint chord, PlanePoint& centre) {
    const PlanePoint normal = left_of(tangent);
    const double height = dot(normal, chord);
    if (std::fabs(height) < 4 * flat_mm) return 0;
    const double radius = dot(chord, chord) / (2 * height);
    if (std::fabs(radius) > largest_radius_mm) return 0;
    centre = at + normal * radius;
    return radius;
}

}  // namespace

PlanePoint CubicBezier::at(double t) const {
    if (t == 1) return points[3];
    const PlanePoint a = interpolated(points[0], points[1], t);
    const PlanePoint b = interpolated(points[1], points[2], t);
    const PlanePoint c = interpolated(points[2], points[3], t);
    return interpolated(interpolated(a, b, t), interpolated(b, c, t), t);
}

PlanePoint CubicBezier::tangent(double t, bool before) const {
    const PlanePoint a = points[1] - points[0];
    const PlanePoint b = points[2] - points[1];
    const PlanePoint c = points[3] - points[2];
    const double min_length = polygon_length(points) * no_direction;
    PlanePoint first = interpolated(interpolated(a, b, t), interpolated(b, c, t), t);
    if (length(first) <= min_length) {
        const PlanePoint second = interpolated(b - a, c - b, t);
        first = before ? second * -1 : second;
    }
    if (length(first) <= min_length) first = (c - b) - (b - a);
    return first * (1 / length(first));
}

void CubicBezier::range(double PlanePoint::*coordinate, double& min, double& max) const {
    const double start = points[0].*coordinate, end = points[3].*coordinate;
    min = std::min(start, end);
    max = std::max(start, end);
    // The derivative is a t^2 + 2 b t + c.
    const double c = points[1].*coordinate - start;
    const double middle = points[2].*coordinate - points[1].*coordinate;
    const double a = c - 2 * middle + (end - points[2].*coordinate);
    const double b = middle - c;
    const double square = b * b - a * c;
    if (square < 0) return;
    const double q = -(b + (b < 0 ? -std::sqrt(square) : std::sqrt(square)));
    for (const double t : {a != 0 ? q / a : 0.0, q != 0 ? c / q : 0.0}) {
        if (!(t > 0 && t < 1)) continue;
        const double value = at(t).*coordinate;
        min = std::min(min, value);
        max = std::max(max, value);
    }
}

bool CubicBezier::is_point() const {
    return polygon_length(points) < 1e-9;
}

CubicBezier quadratic(PlanePoint start, PlanePoint control, PlanePoint end) {
    return {{start, start + (control - start) * (2.0 / 3), end + (control - end) * (2.0 / 3), end}};
}

void BiarcApproximator::begin(const CubicBezier& curve, const Move& pattern) {
    curve_ = curve;
    pattern_ = pattern;
    at_ = 0;
    width_ = finest;
    given_ = 2;
}

bool BiarcApproximator::next(Move& move) {
    if (given_ == 2 && !piece()) return false;
    move = half(given_++);
    return true;
}

/// Computes the next part of the curve: as long as possible, starting with twice the length of the last one.
bool BiarcApproximator::piece() {
    if (at_ == finest) return false;
    width_ = std::min(width_, finest / 2) * 2;
    while (at_ % width_ != 0) width_ /= 2;
    constexpr double step = 1.0 / finest;
    while (!fit(at_ * step, (at_ + width_) * step, biarc_)) width_ /= 2;
    at_ += width_;
    given_ = biarc_.radius[0] == 0 && biarc_.radius[1] == 0 && length(biarc_.joint - biarc_.to) == 0 ? 1 : 0;
    return true;
}

/// Fits a biarc to a part of the curve. Returns false if the part is too long for the tolerance.
bool BiarcApproximator::fit(double from, double to, Biarc& biarc) const {
    biarc.from = curve_.at(from);
    biarc.to = curve_.at(to);
    biarc.tangent_in = curve_.tangent(from, false);
    biarc.tangent_out = curve_.tangent(to, true);
    biarc.radius = {0, 0};
    const PlanePoint chord = biarc.to - biarc.from;
    const double size = (to - from) * polygon_length(curve_.points) * 3;
    if (size <= tolerance || to - from <= 1.0 / finest) {  // a straight line is within tolerance
        biarc.joint = biarc.to;
        return true;
    }
    const double cosine = dot(biarc.tangent_in, biarc.tangent_out);
    const bool gentle = cosine > 0.5 && dot(chord, biarc.tangent_in) > 0 && dot(chord, biarc.tangent_out) > 0;
    if (!gentle) return false;
    // With tangents of equal length the joint is in the middle between their tips.
    const double along = dot(chord, biarc.tangent_in + biarc.tangent_out);
    const double square = dot(chord, chord);
    const double reach = square / (along + std::sqrt(along * along + 2 * (1 - cosine) * square));
    const PlanePoint tip_in = biarc.from + biarc.tangent_in * reach;
    const PlanePoint tip_out = biarc.to - biarc.tangent_out * reach;
    biarc.joint = interpolated(tip_in, tip_out, 0.5);
    biarc.tangent_joint = tip_out - tip_in;
    biarc.radius[0] = arc_through(biarc.from, biarc.tangent_in, biarc.joint - biarc.from, biarc.centre[0]);
    biarc.radius[1] = arc_through(biarc.to, biarc.tangent_out, biarc.joint - biarc.to, biarc.centre[1]);
    return near(from, to, biarc);
}

bool BiarcApproximator::near(double from, double to, const Biarc& biarc) const {
    for (int i = 1; i < samples; ++i) {
        const PlanePoint place = curve_.at(from + (to - from) * i / samples);
        const std::size_t which = dot(place - biarc.joint, biarc.tangent_joint) < 0 ? 0 : 1;
        const PlanePoint begin = which == 0 ? biarc.from : biarc.joint;
        const PlanePoint chord = (which == 0 ? biarc.joint : biarc.to) - begin;
        const double off = biarc.radius[which] != 0
                               ? length(place - biarc.centre[which]) - std::fabs(biarc.radius[which])
                               : cross(chord, place - begin) / length(chord);
        if (!(std::fabs(off) <= tolerance)) return false;
    }
    return true;
}

Move BiarcApproximator::half(std::size_t which) const {
    Move move = pattern_;
    const PlanePoint end = which == 0 ? biarc_.joint : biarc_.to;
    move.kind = biarc_.radius[which] == 0 ? MoveKind::feed : MoveKind::arc;
    if (move.kind == MoveKind::arc) {
        move.first = 0;
        move.second = 1;
        // The sign of both radii is the direction of the arc: seen from `to`, the chord and so the height are reversed,
        // but their quotient is not.
        move.turns = biarc_.radius[which] > 0 ? 1 : -1;
        move.centre_first = biarc_.centre[which].first;
        move.centre_second = biarc_.centre[which].second;
    }
    move.end[0] = end.first;
    move.end[1] = end.second;
    return move;
}

}  // namespace motionrack::control::gcode
