// Rounding to pulses, and the search for the integer centre with which the chip's arc ends at its target.
#include <cmath>
#include <motionrack/cards/mcx314/arithmetic.hpp>
#include <motionrack/cards/mcx314/axes/geometry.hpp>

namespace motionrack::mcx314 {

Pulses4 AxisMap::pulses(const control::Point& position) const {
    Pulses4 out = {};
    for (std::size_t i = 0; i < channel.size(); ++i)
        if (channel[i] >= 0)
            out[static_cast<std::size_t>(channel[i])] = nearest_pulse(position[i], limits[i].pulses_per_unit);
    return out;
}

namespace {

/// Returns true if the chip must be able to move an axis on this path. Along a line this includes axes with a tiny
/// share: of many lines with less than a pulse each, one has the pulse. Beside an arc, which the chip draws itself if
/// no other axis moves, only a full pulse counts.
bool has_part(const AxisMap& map, const control::Geometry& path, const control::Point& components, std::size_t axis) {
    constexpr double min_of_line = 1e-6;  // pulses: more than the rounding of coordinates
    const double scale = map.limits[axis].pulses_per_unit, pulses = components[axis] * path.length * scale;
    if (path.shape != control::PathShape::arc) return pulses >= min_of_line;
    if (axis == path.first || axis == path.second) return pulses >= 0.5;
    return nearest_pulse(path.start[axis], scale) != nearest_pulse(path.end[axis], scale);
}

}  // namespace

DriveMotion drawing_of(const AxisMap& map, const control::Geometry& path, std::uint8_t axes) {
    const control::Point components = control::max_tangent_components(path);
    DriveMotion out;
    int moving = 0, last = -1;
    bool rotary = false, beside_plane = false;
    double scale = 0, min_scale = 1e300;
    for (std::size_t i = 0; i < components.size(); ++i) {
        if (map.channel[i] < 0 || !(axes != 0 ? (axes >> i & 1) != 0 : has_part(map, path, components, i))) continue;
        ++moving;
        last = map.channel[i];
        out.channels |= static_cast<std::uint8_t>(1u << last);
        rotary = rotary || i >= 3;
        beside_plane = beside_plane || (path.shape == control::PathShape::arc && i != path.first && i != path.second);
        scale = std::max(scale, map.limits[i].pulses_per_unit);
        min_scale = std::min(min_scale, map.limits[i].pulses_per_unit);
    }
    out.auxiliary = moving > 3 ? last : -1;
    out.constant_vector = moving == 2 && !rotary && !beside_plane && scale - min_scale <= 1e-9 * scale;
    return out;
}

double basic_pulses_along(const AxisMap& map, const DriveMotion& drawing, const control::Point& tangent) {
    double max_rate = 0, second = 0;
    for (std::size_t i = 0; i < tangent.size(); ++i) {
        if (map.channel[i] < 0 || map.channel[i] == drawing.auxiliary) continue;
        const double rate = std::fabs(tangent[i]) * map.limits[i].pulses_per_unit;
        second = std::max(second, std::min(max_rate, rate));
        max_rate = std::max(max_rate, rate);
    }
    return std::max(1e-3, drawing.constant_vector ? max_rate + both_axes_extra * second : max_rate);
}

namespace {

double length(double x, double y) {
    return std::sqrt(x * x + y * y);
}

/// Centre of an arc relative to its start. An arc that starts beside the true circle, because the previous arc ended
/// there, returns to the circle by its end: its centre is the point nearest to the true one that is equidistant from
/// both.
std::array<double, 2> wanted_centre(const ArcRequest& wanted, double end_x, double end_y) {
    constexpr double rounding = 0.75;
    const double x = wanted.centre[0] - static_cast<double>(wanted.start[0]),
                 y = wanted.centre[1] - static_cast<double>(wanted.start[1]);
    const double chord = length(end_x, end_y);
    if (std::fabs(length(x, y) - wanted.radius) < rounding || chord < 1) return {x, y};
    const double across = (-(x - end_x / 2) * end_y + (y - end_y / 2) * end_x) / (chord * chord);
    return {end_x / 2 - end_y * across, end_y / 2 + end_x * across};
}

}  // namespace

std::optional<ChipArc> fit_arc(const ArcRequest& wanted) {
    const std::array<std::int64_t, 2> finish = {wanted.end[0] - wanted.start[0], wanted.end[1] - wanted.start[1]};
    const std::array<double, 2> ideal =
        wanted_centre(wanted, static_cast<double>(finish[0]), static_cast<double>(finish[1]));
    const double radius = length(ideal[0], ideal[1]);
    std::optional<ChipArc> best;
    bool best_exact = false;
    for (int dx = -2; dx <= 3; ++dx) {
        for (int dy = -2; dy <= 3; ++dy) {
            const std::int64_t cx = static_cast<std::int64_t>(std::floor(ideal[0])) + dx;
            const std::int64_t cy = static_cast<std::int64_t>(std::floor(ideal[1])) + dy;
            const rules::ArcEnd end = rules::end_of_arc(cx, cy, finish[0], finish[1], wanted.clockwise);
            const double own_radius = length(static_cast<double>(cx), static_cast<double>(cy));
            const double off = length(static_cast<double>(cx) - ideal[0], static_cast<double>(cy) - ideal[1]) +
                               std::fabs(own_radius - radius);
            // One basic pulse is 1 .. 1.414 pulses of path: a longer arc has made one turn too many.
            if (static_cast<double>(end.basic_pulses) > wanted.length * 1.02 + 8) continue;
            const bool exact = end.first == finish[0] && end.second == finish[1];
            if (best && (best_exact > exact || (best_exact == exact && best->deviation_pulses <= off))) continue;
            best = ChipArc{{static_cast<std::int32_t>(cx), static_cast<std::int32_t>(cy)},
                           {static_cast<std::int32_t>(finish[0]), static_cast<std::int32_t>(finish[1])},
                           {static_cast<std::int32_t>(end.first), static_cast<std::int32_t>(end.second)},
                           end.basic_pulses,
                           off};
            best_exact = exact;
        }
    }
    return best;
}

}  // namespace motionrack::mcx314
