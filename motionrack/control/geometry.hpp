// Geometry of one move: its length, the position and tangent after a length, and the distance of a point from it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// XYZ paths and radii below this (mm; degrees for rotary moves) count as zero: far below any pulse and far above the
/// rounding of coordinates.
inline constexpr double min_length_mm = 1e-9;

/// Arcs with a smaller sweep (rad) are full circles, as is an arc that ends at its start.
inline constexpr double min_sweep_rad = 1e-9;

enum class PathShape : std::uint8_t {
    nothing,  ///< no motion: a dwell, or a move shorter than min_length_mm
    line,     ///< straight in XYZ, the rotary axes in proportion
    arc,      ///< an arc or helix; the rotary axes move in proportion to the angle
    rotary    ///< only ABC move
};

/// Geometry of a move with its start, computed once. Lengths are mm along XYZ (helix: along the helix); where only ABC
/// move, degrees of the axis with the largest motion. Tangents are changes of the six axes per unit of that length.
struct Geometry {
    PathShape shape = PathShape::nothing;
    std::uint8_t first = 0;  ///< arc: axes of its plane and the axis along the helix
    std::uint8_t second = 1;
    std::uint8_t third = 2;
    double length = 0;
    Point start = {};
    Point end = {};
    Point tangent_in = {};     ///< tangent at the start
    Point tangent_out = {};    ///< tangent at the end
    double centre_first = 0;   ///< arc: centre on axis `first`, mm
    double centre_second = 0;  ///< arc: centre on axis `second`, mm
    double radius = 0;         ///< arc: mm, in its plane; mean of start and end radius, which may differ by rounding
    double radius_growth = 0;  ///< arc: (radius at the end / radius at the start) - 1
    double sweep = 0;          ///< arc: rad, > 0 counter-clockwise seen from the positive third axis
};

/// Computes the geometry of `move` from `start`. Never fails: an arc without a radius or turns is treated as a line, a
/// dwell as no motion.
Geometry geometry_of(const Move& move, const Point& start);

/// Returns the position of all six axes after `length` along the path; clamps exactly to the start and the end.
Point position_at(const Geometry& path, double length);

/// Returns the tangent after `length` of the path (0 .. path.length).
Point tangent_at(const Geometry& path, double length);

/// Returns the largest absolute tangent component of each axis over the whole path.
Point max_tangent_components(const Geometry& path);

/// Returns the fraction of the length that lies in the plane of the arc: 1 for an arc, less for a helix, 0 otherwise.
double plane_fraction(const Geometry& path);

/// Returns the radius of curvature of the XYZ path in mm (helix: larger than its radius); infinity for lines and rotary
/// moves.
double curvature_radius(const Geometry& path);

/// Returns the distance in mm from the XYZ point to the nearest point of the path. Exact for lines and arcs. For a
/// helix it searches the nearest turns, which is exact while the distance is well below the radius.
double distance_to(const Geometry& path, double x, double y, double z);

}  // namespace motionrack::control
