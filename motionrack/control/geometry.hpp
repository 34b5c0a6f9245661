// The shape of one move: how long it is, where it is after a length, which way it points, and how far a point lies from
// it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// XYZ paths and radii shorter than this (mm; degrees for rotary moves) count as none: it is far below any pulse and
/// far above the rounding of coordinates.
inline constexpr double min_length_mm = 1e-9;

/// Arcs that turn by less than this (rad) are whole turns, as an arc that ends where it starts is.
inline constexpr double min_sweep_rad = 1e-9;

enum class PathShape : std::uint8_t {
    nothing,  ///< nothing moves: a dwell, or a move that is shorter than min_length_mm
    line,     ///< XYZ moves straight, the rotary axes in proportion
    arc,      ///< an arc or helix; the rotary axes move in proportion to the angle
    rotary    ///< only ABC move
};

/// A move with its start, worked out once. Lengths are mm along XYZ (helix: along the helix); where only ABC move,
/// degrees of the axis that turns most. Tangents are changes of the six axes per unit of that length.
struct Geometry {
    PathShape shape = PathShape::nothing;
    std::uint8_t first = 0;  ///< arc: the axes of its plane and the axis along the helix
    std::uint8_t second = 1;
    std::uint8_t third = 2;
    double length = 0;
    Point start = {};
    Point end = {};
    Point tangent_in = {};     ///< at the start
    Point tangent_out = {};    ///< at the end
    double centre_first = 0;   ///< arc: mm
    double centre_second = 0;  ///< arc: mm
    double radius = 0;         ///< arc: mm, in its plane; mean of start and end, which may differ by a rounding
    double radius_growth = 0;  ///< arc: (radius at the end / radius at the start) - 1
    double sweep = 0;          ///< arc: rad, > 0 counter-clockwise seen from the positive third axis
};

/// Works out the shape of `move` from `start`. Never fails: an arc without radius or turns is taken as a line, a dwell
/// as nothing.
Geometry geometry_of(const Move& move, const Point& start);

/// All six axes after `length` of the path; before 0 the start and beyond the end the end, exactly.
Point position_at(const Geometry& path, double length);

/// The tangent after `length` of the path (0 .. path.length).
Point tangent_at(const Geometry& path, double length);

/// Greatest absolute tangent component of each axis anywhere on the path.
Point max_tangent_components(const Geometry& path);

/// Part of the path's length that lies in the plane of the arc: 1 for an arc, less for a helix; 0 if this is no arc.
double plane_fraction(const Geometry& path);

/// Radius of curvature of the XYZ path in mm (helix: greater than its radius); infinity for lines and rotary moves.
double curvature_radius(const Geometry& path);

/// Distance in mm from the XYZ point to the nearest point of the path. Exact for lines and arcs; for a helix the
/// nearest turns are searched, which finds the nearest point whenever the distance is well below the radius.
double distance_to(const Geometry& path, double x, double y, double z);

}  // namespace motionrack::control
