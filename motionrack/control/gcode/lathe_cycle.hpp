// Turning cycles G70 .. G72.2: from the contour of a work piece to the moves that cut it, in one plane; no words and no
// modes.
//
//     G71, seen with Z to the right:                    G72 is the same with X and Z exchanged.
//
//     X  T <───────────────────────────────── T start   levels I apart, from the start towards the contour;
//        :  <───────────────────────────────  /         each: F along, T back by R aslant, T to the next one
//        :      <─────────────────────────── /          on the line from the start to the contour's begin;
//        F <─┐          ┌──<──┐<─────────── /           then F along the contour, with a distance D beside it
//            └─<─┐ ┌─<──┘     └──<───────── begin
//                └─┘ a pocket: its levels when the contour goes down into it (G71.1: passed over; G71.2: only these)
//
// All lengths are mm. In PlanePoint `first` is Z, `second` is X (G18).
#pragma once

#include <cstdint>
#include <motionrack/control/gcode/arc.hpp>
#include <motionrack/control/move.hpp>
#include <string>
#include <vector>

namespace motionrack::control::gcode {

/// Whether a G code in tenths is one of these.
constexpr bool is_turning(std::int16_t code) {
    return code >= 700 && code <= 722;
}

/// A line or an arc of at most one turn.
struct ContourSegment {
    PlanePoint from, to;
    std::int32_t turns = 0;  ///< arc: 1 counter-clockwise, -1 clockwise, as Move::turns of G18; 0: line
    PlanePoint centre;       ///< arc
    double corner =
        0;  ///< at its end: radius of a fillet (A), or of the fillet whose chord is a chamfer (C); 0: neither
    bool chamfer = false;
    std::int32_t line = 0;  ///< of the source
    bool arc() const { return turns != 0; }
};

struct LatheCycle {
    std::int16_t code = 710;  ///< in tenths: 700, 710 711 712, 720 721 722
    PlanePoint start;         ///< from where it cuts
    double distance =
        0;  ///< D: what is left on the contour; of G70 that of the first pass would be, were there one more
    double end_distance = 0;  ///< E of G70: of the last pass
    std::int32_t passes = 1;  ///< P of G70
    double depth = 1;         ///< I: between two levels, > 0
    double retract = 0.5;     ///< R: up and back after a cut, >= 0
};

struct LatheMove {
    MoveKind kind = MoveKind::feed;  ///< traverse, feed or arc
    PlanePoint to;
    PlanePoint centre;
    std::int32_t turns = 0;
};

/// Moves that one cycle may make.
inline constexpr std::size_t max_turning_moves = 1'000'000;

/// `contour`: one piece or more, each from the end of the one before; the machine stands at `from`. Gives the moves; a
/// sentence if there are none, and nothing is of use then.
std::string make_lathe_moves(const LatheCycle& plan, std::vector<ContourSegment> contour, PlanePoint from,
                             std::vector<LatheMove>& moves);

// ---- what it is made of

/// The plane as the cycle sees it: `first` along the cut, `second` away from the work piece.
struct CuttingOrientation {
    bool swapped = false;  ///< along X
    double along = 1;      ///< or -1
    double away = 1;

    PlanePoint in(PlanePoint p) const {
        return swapped ? PlanePoint{p.second * along, p.first * away} : PlanePoint{p.first * along, p.second * away};
    }
    PlanePoint out(PlanePoint p) const {
        return swapped ? PlanePoint{p.second * away, p.first * along} : PlanePoint{p.first * along, p.second * away};
    }
    std::int32_t turns(std::int32_t seen) const { return (along * away > 0) != swapped ? seen : -seen; }
};

/// Puts in the fillets and chamfers; from there on pieces have none.
std::string insert_fillets(std::vector<ContourSegment>& contour);

/// Cuts arcs where they are highest or lowest (`second`). A sentence if the contour goes back along `first` anywhere.
std::string make_monotone(std::vector<ContourSegment>& contour, char axis);

/// The contour at a distance >= 0 left of it: with arcs about corners that it turns away from.
std::string offset_contour(const std::vector<ContourSegment>& contour, double distance,
                           std::vector<ContourSegment>& beside);

}  // namespace motionrack::control::gcode
