// Where the centre of a round cutter goes beside a contour: geometry in one plane, no words and no modes.
//
//        programmed  ────────────┐ corner            G41: the cutter is left of the contour, G42: right of it.
//                                │                   convex corner: an arc of the cutter's radius about the corner;
//     G41   ─ ─ ─ ─ ─ ─ ─ ─ ─ ╮  │                   concave corner: both moves end where their parallels meet;
//                    arc put in  ╎ │                 tangent joint: the moves go on as they are.
//
// All lengths are mm. Vectors: (first, second) axis of the plane; angles and turns counter-clockwise where positive.
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>

namespace motionrack::control::gcode {

/// A joint is taken as tangent where the two ends beside it are no farther apart than this, and an arc is left out
/// where the parallels meet no farther than this from it; mm. So far the cutter may be off the exact place.
inline constexpr double cutter_tolerance_mm = 0.001;

/// The path of the cutter's centre beside one move, as if that move were alone.
struct CutterPath {
    bool arc = false;
    std::int32_t turns = 0;    ///< arc: as Move::turns
    PlanePoint start;          ///< beside the start of the contour's move
    PlanePoint end;            ///< beside its end
    PlanePoint direction_in;   ///< unit vectors along the contour at its start
    PlanePoint direction_out;  ///< and at its end
    PlanePoint centre;         ///< arc
    double radius_in = 0;      ///< arc: of the cutter's path at its start
    double radius_out = 0;     ///< and at its end, which may differ by a rounding
    double sweep = 0;          ///< arc: rad from start to end, of the sign of `turns`
    double curvature = 0;      ///< curvature of the contour, 1/mm, > 0 counter-clockwise
};

/// `offset`: the cutter's radius, > 0 left of the contour, < 0 right of it. The ends must differ.
CutterPath offset_line(PlanePoint from, PlanePoint to, double offset);

/// False: the cutter does not fit into the arc from inside.
bool offset_arc(PlanePoint from, PlanePoint to, PlanePoint centre, std::int32_t turns, double offset, CutterPath& path);

/// The first straight move: from where the cutter stands to beside the end.
CutterPath lead_in_line(PlanePoint from, PlanePoint to, double offset);

/// The first move if it is an arc: from where the cutter stands, tangent to the contour's parallel at the end. False:
/// no arc does that.
bool lead_in_arc(PlanePoint from, PlanePoint to, PlanePoint centre, std::int32_t turns, double offset,
                 CutterPath& path);

enum class CornerJoin : std::uint8_t {
    straight_on,  ///< the second move begins where the first ends
    meeting,      ///< both at `at`
    around,       ///< an arc of the cutter's radius about the corner joins the two
    none          ///< the cutter does not fit into the corner
};

struct CornerJoinPoint {
    CornerJoin kind = CornerJoin::none;
    PlanePoint at;
};

/// How the paths beside two moves that meet at `corner` are joined.
CornerJoinPoint join_corner(const CutterPath& before, const CutterPath& after, PlanePoint corner, double offset);

/// Lets the path begin and end elsewhere on its line or circle; sets its turns. False: it would have to go backwards,
/// so the cutter would cut into the contour.
bool trim(CutterPath& path, PlanePoint from, PlanePoint to);

}  // namespace motionrack::control::gcode
