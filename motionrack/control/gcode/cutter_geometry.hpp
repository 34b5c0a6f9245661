// Path of the centre of a round cutter beside a contour: geometry in one plane, without words and modes.
//
//        programmed  ────────────┐ corner            G41: the cutter is left of the contour, G42: right of it.
//                                │                   convex corner: an arc of the cutter radius about the corner;
//     G41   ─ ─ ─ ─ ─ ─ ─ ─ ─ ╮  │                   concave corner: both moves end where their offset paths meet;
//                 inserted arc ╎ │                   tangent junction: the moves continue unchanged.
//
// All lengths are mm. Vectors: (first, second) axis of the plane; positive angles and turns are counter-clockwise.
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>

namespace motionrack::control::gcode {

/// A junction is tangent if the two offset ends are at most this far apart. No arc is inserted where the offset paths
/// meet within this distance; mm. The cutter may deviate by as much.
inline constexpr double cutter_tolerance_mm = 0.001;

/// Path of the cutter centre beside one move, without its neighbours.
struct CutterPath {
    bool arc = false;
    std::int32_t turns = 0;    ///< arc: as Move::turns
    PlanePoint start;          ///< offset from the start of the contour move
    PlanePoint end;            ///< offset from the end of the contour move
    PlanePoint direction_in;   ///< unit vector along the contour at its start
    PlanePoint direction_out;  ///< unit vector along the contour at its end
    PlanePoint centre;         ///< arc: its centre
    double radius_in = 0;      ///< arc: radius of the cutter path at its start
    double radius_out = 0;     ///< arc: radius at its end, which may differ by rounding
    double sweep = 0;          ///< arc: rad from start to end, with the sign of `turns`
    double curvature = 0;      ///< curvature of the contour, 1/mm, > 0 counter-clockwise
};

/// Returns the path beside a line. `offset`: the cutter radius, > 0 left of the contour, < 0 right of it. The ends must
/// differ.
CutterPath offset_line(PlanePoint from, PlanePoint to, double offset);

/// Computes the path beside an arc. Returns false if the cutter does not fit into it from inside.
bool offset_arc(PlanePoint from, PlanePoint to, PlanePoint centre, std::int32_t turns, double offset, CutterPath& path);

/// Returns the straight lead-in: from the current position to the point beside the end of the move.
CutterPath lead_in_line(PlanePoint from, PlanePoint to, double offset);

/// Computes the lead-in if it is an arc: from the current position, tangent to the offset path at the end. Returns
/// false if no such arc exists.
bool lead_in_arc(PlanePoint from, PlanePoint to, PlanePoint centre, std::int32_t turns, double offset,
                 CutterPath& path);

enum class CornerJoin : std::uint8_t {
    straight_on,  ///< the second move starts at the end of the first
    meeting,      ///< the two offset moves intersect at `at`
    around,       ///< an arc of the cutter radius about the corner connects them
    none          ///< the cutter does not fit into the corner
};

struct CornerJoinPoint {
    CornerJoin kind = CornerJoin::none;
    PlanePoint at;
};

/// Joins the paths beside two moves that meet at `corner`.
CornerJoinPoint join_corner(const CutterPath& before, const CutterPath& after, PlanePoint corner, double offset);

/// Moves the start and the end of a path on its line or circle, and sets its turns. Returns false if the path would
/// reverse, because the cutter would cut into the contour.
bool trim(CutterPath& path, PlanePoint from, PlanePoint to);

}  // namespace motionrack::control::gcode
