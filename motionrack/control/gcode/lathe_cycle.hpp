// Lathe cycles G70 .. G72.2: from the contour of a workpiece to the moves that cut it, in one plane; without words and
// modes.
//
//     G71, seen with Z to the right:                    G72 is the same with X and Z exchanged.
//
//     X  T <───────────────────────────────── T start   levels I apart, from the start towards the contour;
//        :  <───────────────────────────────  /         each: F along, T back by R on a slant, T to the next one
//        :      <─────────────────────────── /          on the line from the start to the beginning of the contour;
//        F <─┐          ┌──<──┐<─────────── /           then F along the contour, at a distance D from it
//            └─<─┐ ┌─<──┘     └──<───────── begin
//                └─┘ a pocket: its levels when the contour descends into it (G71.1: skipped; G71.2: pockets only)
//
// All lengths are mm. In PlanePoint `first` is Z, `second` is X (G18).
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/move.hpp>
#include <string>
#include <vector>

namespace motionrack::control::gcode {

/// Returns true if a G code in tenths is a lathe cycle.
constexpr bool is_turning(std::int16_t code) {
    return code >= 700 && code <= 722;
}

/// A line or an arc of at most one turn.
struct ContourSegment {
    PlanePoint from, to;
    std::int32_t turns = 0;  ///< arc: 1 counter-clockwise, -1 clockwise, as Move::turns of G18; 0: line
    PlanePoint centre;       ///< arc: its centre
    double corner = 0;  ///< at its end: radius of a fillet (A), or of the fillet whose chord is a chamfer (C); 0: none
    bool chamfer = false;
    std::int32_t line = 0;  ///< source line
    bool arc() const { return turns != 0; }
};

struct LatheCycle {
    std::int16_t code = 710;  ///< G code in tenths: 700, 710 711 712, 720 721 722
    PlanePoint start;         ///< start of cutting
    double distance = 0;      ///< D: remaining stock on the contour; G70: distance of a pass before the first one
    double end_distance = 0;  ///< E of G70: distance of the last pass
    std::int32_t passes = 1;  ///< P of G70
    double depth = 1;         ///< I: distance between two levels, > 0
    double retract = 0.5;     ///< R: retract after a cut, >= 0
};

struct LatheMove {
    MoveKind kind = MoveKind::feed;  ///< rapid, feed or arc
    PlanePoint to;
    PlanePoint centre;
    std::int32_t turns = 0;
};

/// Maximum number of moves of one cycle.
inline constexpr std::size_t max_turning_moves = 1'000'000;

/// Makes the moves of a cycle. `contour`: one segment or more, each from the end of the previous one; `from`: the
/// current position. Returns an error sentence, with unusable moves, or an empty string.
std::string make_lathe_moves(const LatheCycle& plan, std::vector<ContourSegment> contour, PlanePoint from,
                             std::vector<LatheMove>& moves);

// ---- parts of the computation

/// Orientation of the cycle in the plane: `first` along the cut, `second` away from the workpiece.
struct CuttingOrientation {
    bool swapped = false;  ///< the cut is along X; false: along Z
    double along = 1;      ///< direction of the cut on its axis, 1 or -1
    double away = 1;

    PlanePoint in(PlanePoint p) const {
        return swapped ? PlanePoint{p.second * along, p.first * away} : PlanePoint{p.first * along, p.second * away};
    }
    PlanePoint out(PlanePoint p) const {
        return swapped ? PlanePoint{p.second * away, p.first * along} : PlanePoint{p.first * along, p.second * away};
    }
    std::int32_t turns(std::int32_t seen) const { return (along * away > 0) != swapped ? seen : -seen; }
};

/// Inserts the fillets and chamfers; afterwards no segment has a corner radius. Returns an error sentence, or "".
std::string insert_fillets(std::vector<ContourSegment>& contour);

/// Splits arcs at their extremes of `second`. Returns an error sentence if the contour reverses along `first`.
std::string make_monotone(std::vector<ContourSegment>& contour, char axis);

/// Computes the contour `beside` at a distance >= 0 (mm) to the left, with arcs about convex corners. Returns an error
/// sentence, or "".
std::string offset_contour(const std::vector<ContourSegment>& contour, double distance,
                           std::vector<ContourSegment>& beside);

}  // namespace motionrack::control::gcode
