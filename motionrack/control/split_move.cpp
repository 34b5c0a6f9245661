// Parts end on the path of the whole move; a remaining move starts at the current position.
#include <algorithm>
#include <cmath>
#include <limits>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/split_move.hpp>

namespace motionrack::control {

namespace {

/// If the remaining arc would turn by this much (rad) more than before, the position is behind its end.
constexpr double too_much_turn = 0.5;

double share_of_time(const Move& move, double whole, double part) {
    return move.feed_mode == FeedMode::inverse_time && part > 0 ? move.feed * (whole / part) : move.feed;
}

/// Completed share of a move according to some of its axes, and its weight: the square of their travel, pulses^2.
struct WeighedPart {
    double part = 0;
    double weight = 0;
};

/// Finds the position on an arc by the axes outside its plane, weighted by their pulses.
WeighedPart part_beside_plane(const Geometry& path, const Point& position, const PulsesPerUnit& pulses) {
    WeighedPart out;
    for (std::size_t i = 0; i < position.size(); ++i) {
        if (i == path.first || i == path.second) continue;
        const double delta = (path.end[i] - path.start[i]) * pulses[i];
        out.part += (position[i] - path.start[i]) * pulses[i] * delta;
        out.weight += delta * delta;
    }
    if (out.weight > 0) out.part /= out.weight;
    return out;
}

/// Finds the path length on an arc: by the angle in its plane and by the other axes, weighted by their pulses. On a
/// steep helix the angle alone is inaccurate.
double length_on_arc(const Geometry& path, const Point& position, const PulsesPerUnit& pulses) {
    const double x0 = path.start[path.first] - path.centre_first, y0 = path.start[path.second] - path.centre_second;
    const double x = position[path.first] - path.centre_first, y = position[path.second] - path.centre_second;
    const double whole = std::fabs(path.sweep);
    double angle = motionrack::atan2(x0 * y - y0 * x, x0 * x + y0 * y);
    if (path.sweep < 0) angle = -angle;
    if (angle < 0) angle += 2 * pi;
    const WeighedPart beside = part_beside_plane(path, position, pulses);
    const double along = path.radius * whole * std::max(pulses[path.first], pulses[path.second]);
    const double in_plane = std::max(along * along, min_length_mm);
    double best = 0, min_off = std::numeric_limits<double>::infinity();
    for (const double turned : {angle, angle - 2 * pi}) {
        const double by_angle = turned / whole, by_others = beside.part;
        const double part =
            std::clamp((by_angle * in_plane + by_others * beside.weight) / (in_plane + beside.weight), 0.0, 1.0);
        const double off =
            in_plane * (by_angle - part) * (by_angle - part) + beside.weight * (by_others - part) * (by_others - part);
        if (off >= min_off) continue;
        min_off = off;
        best = part;
    }
    return path.length * best;
}

double length_on_straight(const Geometry& path, const Point& position, const PulsesPerUnit& pulses) {
    double along = 0, square = 0;
    for (std::size_t i = 0; i < position.size(); ++i) {
        const double tangent = path.tangent_in[i] * pulses[i];
        along += (position[i] - path.start[i]) * pulses[i] * tangent;
        square += tangent * tangent;
    }
    return square > 0 ? std::clamp(along / square, 0.0, path.length) : 0;
}

}  // namespace

Move sub_move(const Move& move, const Geometry& path, double from, double to) {
    Move part = move;
    part.end = position_at(path, to);
    part.feed = share_of_time(move, path.length, to - from);
    if (path.shape == PathShape::arc) {
        const double turned = std::fabs(path.sweep) * (to - from) / path.length;
        const int turns = 1 + static_cast<int>((turned - min_sweep_rad) / (2 * pi));
        part.turns = move.turns > 0 ? turns : -turns;
    }
    return part;
}

NearestPoint nearest_point(const Geometry& path, const Point& position, const PulsesPerUnit& pulses) {
    NearestPoint out;
    if (path.shape == PathShape::arc)
        out.length = length_on_arc(path, position, pulses);
    else if (path.shape != PathShape::nothing)
        out.length = length_on_straight(path, position, pulses);
    const Point nearest = position_at(path, out.length);
    for (std::size_t i = 0; i < position.size(); ++i)
        out.distance = std::max(out.distance, std::fabs(position[i] - nearest[i]) * pulses[i]);
    return out;
}

Move remaining_move(const Move& move, const Geometry& path, const Point& position, const PulsesPerUnit& pulses) {
    const double left = path.length - nearest_point(path, position, pulses).length;
    Move rest = move;
    rest.feed = share_of_time(move, path.length, left);
    if (path.shape != PathShape::arc) return rest;
    const double turn_left = std::fabs(path.sweep) * left / path.length;
    rest.turns = move.turns > 0 ? 1 : -1;
    const Geometry tried = geometry_of(rest, position);
    if (left <= 0 || tried.shape != PathShape::arc || std::fabs(tried.sweep) > turn_left + too_much_turn) {
        rest.kind = MoveKind::feed;
        rest.turns = 0;
    }
    return rest;
}

}  // namespace motionrack::control
