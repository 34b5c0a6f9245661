// Centres and extreme points of arcs.
#include <cmath>
#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/gcode/plane_point.hpp>

namespace motionrack::control::gcode {

namespace {

/// Returns true if `v` comes before `w` when turning counter-clockwise from `from`; a `v` along `from` is always first.
bool comes_before(PlanePoint from, PlanePoint v, PlanePoint w) {
    const auto second_half = [&](PlanePoint p) {
        return !(cross(from, p) > 0 || (cross(from, p) == 0 && dot(from, p) > 0));
    };
    const bool v_second = second_half(v);
    const bool w_second = second_half(w);
    if (v_second != w_second) return w_second;
    return cross(v, w) > 0;
}

}  // namespace

double length(PlanePoint v) {
    return std::sqrt(dot(v, v));
}

bool centre_from_radius(PlanePoint start, PlanePoint end, double radius, bool counter_clockwise, PlanePoint& centre) {
    const PlanePoint chord = {end.first - start.first, end.second - start.second};
    const double whole = length(chord);
    const double half = whole / 2;
    const double size = std::fabs(radius);
    if (half - size > radius_slack_mm) return false;
    const double height = half >= size ? 0 : std::sqrt((size - half) * (size + half));
    const double side = counter_clockwise == (radius > 0) ? height / whole : -height / whole;
    centre.first = start.first + chord.first / 2 - chord.second * side;
    centre.second = start.second + chord.second / 2 + chord.first * side;
    return true;
}

std::array<bool, 4> extremes_passed(PlanePoint from, PlanePoint to, bool counter_clockwise) {
    constexpr std::array<PlanePoint, 4> extremes = {PlanePoint{1, 0}, PlanePoint{0, 1}, PlanePoint{-1, 0},
                                                    PlanePoint{0, -1}};
    if (!counter_clockwise) std::swap(from, to);
    std::array<bool, 4> passed = {};
    for (std::size_t i = 0; i < 4; ++i) passed[i] = comes_before(from, extremes[i], to);
    return passed;
}

}  // namespace motionrack::control::gcode
