// Places in a plane: its axes, sums and products.
#pragma once

#include <array>
#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>

namespace motionrack::control::gcode {

/// First, second and third axis of G17, G18, G19: the first turns towards the second seen from above the third.
inline constexpr std::array<std::array<std::uint8_t, 3>, 3> plane_axes = {{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};

inline Planar operator+(Planar a, Planar b) {
    return {a.first + b.first, a.second + b.second};
}
inline Planar operator-(Planar a, Planar b) {
    return {a.first - b.first, a.second - b.second};
}
inline Planar operator*(Planar a, double k) {
    return {a.first * k, a.second * k};
}
inline double cross(Planar a, Planar b) {
    return a.first * b.second - a.second * b.first;
}
inline double dot(Planar a, Planar b) {
    return a.first * b.first + a.second * b.second;
}
inline Planar left_of(Planar v) {
    return {-v.second, v.first};
}

}  // namespace motionrack::control::gcode
