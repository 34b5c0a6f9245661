// Lines, arcs and helices by length. Cost: one square root a move, plus one arc tangent for arcs; one sine and cosine a
// position.

#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/geometry.hpp>

namespace motionrack::control {
namespace {

constexpr int linear_axes = 3;

void make_straight(Geometry& path) {
    Point change;
    for (int i = 0; i < axis_count; ++i) change[i] = path.end[i] - path.start[i];
    double length = std::sqrt(change[0] * change[0] + change[1] * change[1] + change[2] * change[2]);
    path.shape = PathShape::line;
    if (length < min_length_mm) {
        length = std::max({std::fabs(change[3]), std::fabs(change[4]), std::fabs(change[5])});
        path.shape = PathShape::rotary;
        if (length < min_length_mm) {
            path.shape = PathShape::nothing;
            return;
        }
    }
    path.length = length;
    const double per_length = 1 / length;
    for (int i = 0; i < axis_count; ++i) path.tangent_in[i] = change[i] * per_length;
    path.tangent_out = path.tangent_in;
}

/// Returns the angle from (x0, y0) to (x1, y1) in the direction and number of turns of the move.
double swept_angle(double x0, double y0, double x1, double y1, int turns) {
    double angle = motionrack::atan2(x0 * y1 - y0 * x1, x0 * x1 + y0 * y1);
    const double whole = turns > 0 ? 2 * pi : -2 * pi;
    if (std::fabs(angle) < min_sweep_rad) {
        angle = whole;
    } else if ((angle > 0) != (turns > 0)) {
        angle += whole;
    }
    return angle + whole * (std::abs(turns) - 1);
}

/// Returns false, with an incomplete geometry, if the arc has no radius.
bool make_arc(Geometry& path, const Move& move) {
    const int first = move.first;
    const int second = move.second;
    const double x0 = path.start[first] - move.centre_first;
    const double y0 = path.start[second] - move.centre_second;
    const double x1 = path.end[first] - move.centre_first;
    const double y1 = path.end[second] - move.centre_second;
    const double radius_start = std::sqrt(x0 * x0 + y0 * y0);
    const double radius_end = std::sqrt(x1 * x1 + y1 * y1);
    if (radius_start < min_length_mm || radius_end < min_length_mm) return false;

    path.shape = PathShape::arc;
    path.first = move.first;
    path.second = move.second;
    path.third = static_cast<std::uint8_t>(3 - first - second);
    path.centre_first = move.centre_first;
    path.centre_second = move.centre_second;
    path.radius = 0.5 * (radius_start + radius_end);
    path.radius_growth = radius_end / radius_start - 1;
    path.sweep = swept_angle(x0, y0, x1, y1, move.turns);
    const double along = path.end[path.third] - path.start[path.third];
    const double around = path.radius * path.sweep;
    path.length = std::sqrt(around * around + along * along);
    const double per_length = 1 / path.length;
    for (int i = 0; i < axis_count; ++i) path.tangent_in[i] = (path.end[i] - path.start[i]) * per_length;
    path.tangent_out = path.tangent_in;
    const double turning = around * per_length;
    path.tangent_in[first] = -y0 / radius_start * turning;
    path.tangent_in[second] = x0 / radius_start * turning;
    path.tangent_out[first] = -y1 / radius_end * turning;
    path.tangent_out[second] = x1 / radius_end * turning;
    return true;
}

/// Returns the angle of a point in the plane of an arc, in the direction of the arc from its start, in [0, 2 pi).
double angle_from_start(const Geometry& path, double x, double y) {
    const double x0 = path.start[path.first] - path.centre_first;
    const double y0 = path.start[path.second] - path.centre_second;
    double angle = motionrack::atan2(x0 * y - y0 * x, x0 * x + y0 * y);
    if (path.sweep < 0) angle = -angle;
    return angle < 0 ? angle + 2 * pi : angle;
}

double distance_to_line(const Geometry& path, const std::array<double, 3>& point) {
    double along = 0;
    if (path.shape == PathShape::line) {
        for (int i = 0; i < linear_axes; ++i) along += (point[i] - path.start[i]) * path.tangent_in[i];
        along = std::clamp(along, 0.0, path.length);
    }
    const Point nearest = position_at(path, along);
    double squares = 0;
    for (int i = 0; i < linear_axes; ++i) squares += (point[i] - nearest[i]) * (point[i] - nearest[i]);
    return std::sqrt(squares);
}

/// A point relative to a helix: distance from its axis, angle from its start in its direction, height over its start.
struct HelixPoint {
    double from_axis;
    double angle;
    double height;
};

/// Returns the squared distance from `point` to the helix at `angle` from its start; `rise` is the height per radian.
double helix_square(const Geometry& path, const HelixPoint& point, double angle, double rise) {
    const double whole = std::fabs(path.sweep);
    const double radius = path.radius / (1 + 0.5 * path.radius_growth) * (1 + path.radius_growth * angle / whole);
    const SinCos apart = sin_cos(angle - point.angle);
    const double radial = point.from_axis - radius * apart.cos;
    const double sideways = radius * apart.sin;
    const double height = point.height - rise * angle;
    return radial * radial + sideways * sideways + height * height;
}

/// Returns the minimum squared distance near the turn with this angle: a few Newton steps on the derivative.
double helix_square_near(const Geometry& path, const HelixPoint& point, double angle, double rise) {
    const double whole = std::fabs(path.sweep);
    angle = std::clamp(angle, 0.0, whole);
    const double rho = point.from_axis * path.radius;
    for (int step = 0; step < 6; ++step) {
        const SinCos apart = sin_cos(angle - point.angle);
        const double slope = rho * apart.sin - rise * (point.height - rise * angle);
        const double second_derivative = rho * apart.cos + rise * rise;
        if (!(second_derivative > 0)) break;
        const double next = std::clamp(angle - slope / second_derivative, 0.0, whole);
        const bool settled = std::fabs(next - angle) < 1e-12;
        angle = next;
        if (settled) break;
    }
    return helix_square(path, point, angle, rise);
}

double distance_to_arc(const Geometry& path, const std::array<double, 3>& point) {
    const double x = point[path.first] - path.centre_first;
    const double y = point[path.second] - path.centre_second;
    const double whole = std::fabs(path.sweep);
    const double climb = path.end[path.third] - path.start[path.third];
    const HelixPoint seen = {std::sqrt(x * x + y * y), angle_from_start(path, x, y),
                             point[path.third] - path.start[path.third]};
    double best = std::min(helix_square(path, seen, 0, climb / whole), helix_square(path, seen, whole, climb / whole));
    if (std::fabs(climb) < min_length_mm) {
        if (seen.angle > whole) return std::sqrt(best);
        // the two turns of a spiral that come nearest to the point's distance from the axis
        const double grown = seen.from_axis * (1 + 0.5 * path.radius_growth) / path.radius - 1;
        const double nearest =
            path.radius_growth == 0 ? 0 : std::floor((grown / path.radius_growth * whole - seen.angle) / (2 * pi));
        const double last = std::floor((whole - seen.angle) / (2 * pi));
        for (const double turn : {nearest, nearest + 1})
            best = std::min(best, helix_square(path, seen, seen.angle + 2 * pi * std::clamp(turn, 0.0, last), 0));
        return std::sqrt(best);
    }
    const double rise = climb / whole;
    // the turn at or below the height of the point, and the next one
    const double turn = std::floor((seen.height / rise - seen.angle) / (2 * pi));
    const double last_turn = std::floor((whole - seen.angle) / (2 * pi));
    const double below = seen.angle + 2 * pi * std::clamp(turn, 0.0, std::max(last_turn, 0.0));
    best = std::min(best, helix_square_near(path, seen, below, rise));
    best = std::min(best, helix_square_near(path, seen, below + 2 * pi, rise));
    return std::sqrt(best);
}

}  // namespace

Geometry geometry_of(const Move& move, const Point& start) {
    Geometry path;
    path.start = start;
    if (move.kind == MoveKind::dwell) {
        path.end = start;
        return path;
    }
    path.end = move.end;
    if (move.kind == MoveKind::arc && move.turns != 0 && make_arc(path, move)) return path;
    make_straight(path);
    return path;
}

Point position_at(const Geometry& path, double length) {
    if (!(length > 0)) return path.start;
    if (length >= path.length) return path.end;
    Point at;
    if (path.shape == PathShape::arc) {
        const double part = length / path.length;
        for (int i = 0; i < axis_count; ++i) at[i] = path.start[i] + (path.end[i] - path.start[i]) * part;
        const SinCos turned = sin_cos(path.sweep * part);
        const double size = 1 + path.radius_growth * part;
        const double x0 = (path.start[path.first] - path.centre_first) * size;
        const double y0 = (path.start[path.second] - path.centre_second) * size;
        at[path.first] = path.centre_first + (x0 * turned.cos - y0 * turned.sin);
        at[path.second] = path.centre_second + (x0 * turned.sin + y0 * turned.cos);
        return at;
    }
    for (int i = 0; i < axis_count; ++i) at[i] = path.start[i] + path.tangent_in[i] * length;
    return at;
}

Point tangent_at(const Geometry& path, double length) {
    Point tangent = path.tangent_in;
    if (path.shape != PathShape::arc) return tangent;
    const SinCos turned = sin_cos(path.sweep * (length / path.length));
    const double x = tangent[path.first];
    const double y = tangent[path.second];
    tangent[path.first] = x * turned.cos - y * turned.sin;
    tangent[path.second] = x * turned.sin + y * turned.cos;
    return tangent;
}

Point max_tangent_components(const Geometry& path) {
    Point components;
    for (int i = 0; i < axis_count; ++i)
        components[i] = std::max(std::fabs(path.tangent_in[i]), std::fabs(path.tangent_out[i]));
    if (path.shape != PathShape::arc) return components;
    // The tangent component of an axis reaches 1 where the other one passes zero; half a turn contains such a point for
    // both.
    const double full = plane_fraction(path);
    const bool half_turn = std::fabs(path.sweep) >= pi;
    const auto passes_zero = [&path](int axis) { return (path.tangent_in[axis] > 0) != (path.tangent_out[axis] > 0); };
    if (half_turn || passes_zero(path.second)) components[path.first] = full;
    if (half_turn || passes_zero(path.first)) components[path.second] = full;
    return components;
}

double plane_fraction(const Geometry& path) {
    return path.shape == PathShape::arc ? path.radius * std::fabs(path.sweep) / path.length : 0;
}

double curvature_radius(const Geometry& path) {
    if (path.shape != PathShape::arc) return std::numeric_limits<double>::infinity();
    const double fraction = plane_fraction(path);
    return path.radius / (fraction * fraction);
}

double distance_to(const Geometry& path, double x, double y, double z) {
    const std::array<double, 3> point = {x, y, z};
    return path.shape == PathShape::arc ? distance_to_arc(path, point) : distance_to_line(path, point);
}

}  // namespace motionrack::control
