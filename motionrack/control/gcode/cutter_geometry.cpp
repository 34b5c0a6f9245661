// Offset paths of lines and arcs, and their intersections.
#include <algorithm>
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/gcode/cutter_geometry.hpp>
#include <motionrack/control/gcode/plane_point.hpp>
#include <motionrack/control/geometry.hpp>

namespace motionrack::control::gcode {

namespace {

/// Directions whose sine is below this are parallel.
constexpr double parallel = 1e-9;

/// A move that returns along itself within this sine, with an arc that bends towards the cutter, has no free path.
constexpr double cusp = 0.05;

double distance(PlanePoint a, PlanePoint b) {
    return length(b - a);
}
PlanePoint unit(PlanePoint v) {
    return v * (1 / length(v));
}

/// Returns the angle from `a` to `b`, in (-pi, pi].
double angle_between(PlanePoint a, PlanePoint b) {
    return motionrack::atan2(cross(a, b), dot(a, b));
}

/// Returns the angle from `a` to `b` in the direction and with the sign of `turns`, above 0 to a full turn.
double part_of_turn(PlanePoint a, PlanePoint b, std::int32_t turns) {
    const double whole = turns > 0 ? 2 * pi : -2 * pi;
    const double angle = angle_between(a, b);
    if (std::fabs(angle) < min_sweep_rad) return whole;
    return (angle > 0) == (turns > 0) ? angle : angle + whole;
}

double sweep_of(const CutterPath& path) {
    const double whole = path.turns > 0 ? 2 * pi : -2 * pi;
    return part_of_turn(path.start - path.centre, path.end - path.centre, path.turns) +
           whole * (std::abs(path.turns) - 1);
}

/// Selects the intersection of two paths: near the corner, on the side to which `towards` points.
struct Near {
    PlanePoint corner;
    PlanePoint towards;

    PlanePoint of(PlanePoint one, PlanePoint two) const {
        const bool one_there = dot(one - corner, towards) > 0;
        const bool two_there = dot(two - corner, towards) > 0;
        if (one_there != two_there) return one_there ? one : two;
        return distance(one, corner) <= distance(two, corner) ? one : two;
    }
};

/// Intersects a line with a circle; a distance below the tolerance counts as contact.
bool meet_line_circle(PlanePoint on, PlanePoint direction, PlanePoint centre, double radius, const Near& near,
                      PlanePoint& at) {
    const PlanePoint foot = on + direction * dot(centre - on, direction);
    const double apart = distance(foot, centre);
    if (apart > radius + cutter_tolerance_mm) return false;
    const double half = apart >= radius ? 0 : std::sqrt((radius - apart) * (radius + apart));
    at = near.of(foot + direction * half, foot - direction * half);
    return true;
}

bool meet_circles(PlanePoint centre_a, double a, PlanePoint centre_b, double b, const Near& near, PlanePoint& at) {
    const double apart = distance(centre_a, centre_b);
    if (apart < cutter_tolerance_mm) return false;
    if (apart > a + b + cutter_tolerance_mm || apart < std::fabs(a - b) - cutter_tolerance_mm) return false;
    const PlanePoint along = (centre_b - centre_a) * (1 / apart);
    const double reach = std::clamp((apart * apart + (a - b) * (a + b)) / (2 * apart), -a, a);
    return meet_line_circle(centre_a + along * reach, left_of(along), centre_a, a, near, at);
}

bool meet(const CutterPath& before, const CutterPath& after, const Near& near, PlanePoint& at) {
    if (before.arc && after.arc)
        return meet_circles(before.centre, before.radius_out, after.centre, after.radius_in, near, at);
    if (before.arc)
        return meet_line_circle(after.start, after.direction_in, before.centre, before.radius_out, near, at);
    if (after.arc) return meet_line_circle(before.end, before.direction_out, after.centre, after.radius_in, near, at);
    const double sine = cross(before.direction_out, after.direction_in);
    if (std::fabs(sine) < parallel) return false;
    at = before.end + before.direction_out * (cross(after.start - before.end, after.direction_in) / sine);
    return true;
}

/// Returns true if the contour turns away from the cutter.
bool is_convex(const CutterPath& before, const CutterPath& after, double offset) {
    const double sine = cross(before.direction_out, after.direction_in);
    const double towards = offset > 0 ? sine : -sine;
    const bool back = dot(before.direction_out, after.direction_in) < 0;
    const double curvature = before.curvature + after.curvature;
    const bool closes = offset > 0 ? curvature < -parallel : curvature > parallel;
    if (back && towards < parallel && towards > -cusp && closes) return false;
    return towards < 0 || (back && towards < parallel);
}

}  // namespace

CutterPath offset_line(PlanePoint from, PlanePoint to, double offset) {
    CutterPath path;
    path.direction_in = path.direction_out = unit(to - from);
    const PlanePoint beside = left_of(path.direction_in) * offset;
    path.start = from + beside;
    path.end = to + beside;
    return path;
}

bool offset_arc(PlanePoint from, PlanePoint to, PlanePoint centre, std::int32_t turns, double offset,
                CutterPath& path) {
    const double sense = turns > 0 ? 1 : -1;
    const double radius_in = distance(centre, from);
    const double radius_out = distance(centre, to);
    path = CutterPath{};
    path.arc = true;
    path.turns = turns;
    path.centre = centre;
    path.radius_in = radius_in - sense * offset;
    path.radius_out = radius_out - sense * offset;
    if (path.radius_in < cutter_tolerance_mm || path.radius_out < cutter_tolerance_mm) return false;
    path.direction_in = left_of(from - centre) * (sense / radius_in);
    path.direction_out = left_of(to - centre) * (sense / radius_out);
    path.start = centre + (from - centre) * (path.radius_in / radius_in);
    path.end = centre + (to - centre) * (path.radius_out / radius_out);
    path.curvature = sense / radius_in;
    path.sweep = sweep_of(path);
    return true;
}

CutterPath lead_in_line(PlanePoint from, PlanePoint to, double offset) {
    CutterPath path = offset_line(from, to, offset);
    path.start = from;
    return path;
}

bool lead_in_arc(PlanePoint from, PlanePoint to, PlanePoint centre, std::int32_t turns, double offset,
                 CutterPath& path) {
    if (!offset_arc(from, to, centre, turns, offset, path)) return false;
    // The centre lies on the line through the end and the contour's centre, equally far from the start and the end.
    const PlanePoint towards = unit(centre - path.end);
    const PlanePoint chord = from - path.end;
    const double along = dot(chord, towards);
    if (std::fabs(along) < parallel * length(chord)) return false;
    const double radius = dot(chord, chord) / (2 * along);
    const double sense = turns > 0 ? 1 : -1;
    if (!(radius > cutter_tolerance_mm)) return false;
    path.start = from;
    path.centre = path.end + towards * radius;
    path.radius_in = path.radius_out = radius;
    path.direction_in = left_of(from - path.centre) * (sense / distance(from, path.centre));
    path.sweep = sweep_of(path);
    return true;
}

CornerJoinPoint join_corner(const CutterPath& before, const CutterPath& after, PlanePoint corner, double offset) {
    const double gap = distance(before.end, after.start);
    if (gap <= cutter_tolerance_mm) return {CornerJoin::straight_on, before.end};
    PlanePoint at;
    const bool convex = is_convex(before, after, offset);
    const PlanePoint turn = after.direction_in - before.direction_out;
    const bool meets = meet(before, after, {corner, convex ? turn * -1 : turn}, at);
    if (!convex) return {meets ? CornerJoin::meeting : CornerJoin::none, at};
    const bool near = meets && distance(at, corner) <= std::fabs(offset) + cutter_tolerance_mm &&
                      distance(at, before.end) <= gap && distance(at, after.start) <= gap;
    return {near ? CornerJoin::meeting : CornerJoin::around, near ? at : before.end};
}

bool trim(CutterPath& path, PlanePoint from, PlanePoint to) {
    if (!path.arc) {
        if (!(dot(to - from, path.direction_out) > min_length_mm)) return false;
        path.start = from;
        path.end = to;
        return true;
    }
    const double sense = path.turns > 0 ? 1 : -1;
    const double whole = 2 * pi;
    const double begun = angle_between(path.start - path.centre, from - path.centre);
    const double left = angle_between(to - path.centre, path.end - path.centre);
    const double sweep = sense * (path.sweep - begun - left);
    if (!(sweep > min_sweep_rad) || !(sweep * path.radius_out > min_length_mm)) return false;
    const double part = sense * part_of_turn(from - path.centre, to - path.centre, path.turns);
    const double turns = std::floor((sweep - part) / whole + 0.5) + 1;
    if (turns < 1) return false;
    path.turns = static_cast<std::int32_t>(sense * turns);
    path.start = from;
    path.end = to;
    path.sweep = sense * (part + whole * (turns - 1));
    return true;
}

}  // namespace motionrack::control::gcode
