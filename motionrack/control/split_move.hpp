// Parts of moves: a long move as short ones, and what is left of a move where the machine stands on it.
#pragma once

#include <motionrack/control/geometry.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// The part of a move from `from` to `to` (lengths along its path, from < to), as a move that begins where the part
/// begins. Ends of parts lie on the path; the last part ends where the move ends, exactly. In inverse time it takes its
/// share of the move's time.
Move sub_move(const Move& move, const Geometry& path, double from, double to);

/// Each axis' pulses per mm or degree: what makes places of linear and rotary axes comparable. An axis with 0 of them
/// does not count.
using PulsesPerUnit = Point;
inline constexpr PulsesPerUnit units_alone = {1, 1, 1, 1, 1, 1};

/// The point of a path that is nearest to a place. An arc may turn by less than a whole turn.
struct Nearest {
    double length = 0;    ///< along the path
    double distance = 0;  ///< greatest difference of any of the six axes, in its pulses
};
Nearest nearest_point(const Geometry& path, const Point& place, const PulsesPerUnit& pulses = units_alone);

/// What is left of a move that was left off at `place`, a few pulses beside its path at most: from there to its end. Of
/// an arc so little may be left that it is a straight line.
Move remaining_move(const Move& move, const Geometry& path, const Point& place,
                    const PulsesPerUnit& pulses = units_alone);

}  // namespace motionrack::control
