// Sums and products of places in a plane.
#pragma once

#include <motionrack/control/gcode/arc.hpp>

namespace motionrack::control::gcode {

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
