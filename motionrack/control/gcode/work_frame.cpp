// Converts program coordinates to machine coordinates and back.
#include <cmath>
#include <motionrack/base/trig.hpp>
#include <motionrack/control/gcode/work_frame.hpp>

namespace motionrack::control::gcode {

Rotation rotation_of(double degrees) {
    const double rest = std::remainder(degrees, 90);  // exact
    const auto quarters = static_cast<long>(std::remainder((degrees - rest) / 90, 4));
    const SinCos both = sin_cos(rest / 180 * pi);
    switch ((quarters + 4) % 4) {
        case 0:
            return {both.cos, both.sin};
        case 1:
            return {-both.sin, both.cos};
        case 2:
            return {-both.cos, -both.sin};
        default:
            return {both.sin, -both.cos};
    }
}

void WorkFrame::activate(int system) {
    const auto active = static_cast<std::size_t>(system);
    for (std::size_t axis = 0; axis < axis_count; ++axis) {
        base[axis] = work[active][axis] + tool[axis];
        offset[axis] = work[active][axis] + g92[axis] + tool[axis];
    }
    is_rotated = rotation_deg[active] != 0;
    const Rotation by = is_rotated ? rotation_of(rotation_deg[active]) : Rotation{1, 0};
    cosine = by.cosine;
    sine = by.sine;
}

Point WorkFrame::rotate(const Point& distance) const {
    Point out = distance;
    out[0] = cosine * distance[0] - sine * distance[1];
    out[1] = sine * distance[0] + cosine * distance[1];
    return out;
}

Point WorkFrame::to_machine(const Point& program) const {
    Point out = program;
    for (std::size_t axis = 0; axis < axis_count; ++axis) out[axis] += is_rotated ? g92[axis] : offset[axis];
    if (!is_rotated) return out;
    out = rotate(out);
    for (std::size_t axis = 0; axis < axis_count; ++axis) out[axis] += base[axis];
    return out;
}

Point WorkFrame::to_program(const Point& machine) const {
    Point out = machine;
    for (std::size_t axis = 0; axis < axis_count; ++axis) out[axis] -= is_rotated ? base[axis] : offset[axis];
    if (!is_rotated) return out;
    const double x = out[0], y = out[1];
    out[0] = cosine * x + sine * y;
    out[1] = cosine * y - sine * x;
    for (std::size_t axis = 0; axis < axis_count; ++axis) out[axis] -= g92[axis];
    return out;
}

}  // namespace motionrack::control::gcode
