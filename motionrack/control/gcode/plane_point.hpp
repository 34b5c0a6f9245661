// Points in a plane: axes, sums and products.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>

namespace motionrack::control::gcode {

/// First, second and third axis of G17, G18, G19: positive rotation turns the first axis towards the second.
inline constexpr std::array<std::array<std::uint8_t, 3>, 3> plane_axes = {{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};

inline PlanePoint operator+(PlanePoint a, PlanePoint b) {
    return {a.first + b.first, a.second + b.second};
}
inline PlanePoint operator-(PlanePoint a, PlanePoint b) {
    return {a.first - b.first, a.second - b.second};
}
inline PlanePoint operator*(PlanePoint a, double k) {
    return {a.first * k, a.second * k};
}
inline double cross(PlanePoint a, PlanePoint b) {
    return a.first * b.second - a.second * b.first;
}
inline double dot(PlanePoint a, PlanePoint b) {
    return a.first * b.first + a.second * b.second;
}
inline PlanePoint left_of(PlanePoint v) {
    return {-v.second, v.first};
}

}  // namespace motionrack::control::gcode
