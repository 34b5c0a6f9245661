// Splitting of moves: a long move into short ones, and the remaining part of an interrupted move.
#pragma once

#include <motionrack/control/geometry.hpp>
#include <motionrack/control/move.hpp>

namespace motionrack::control {

/// Returns the part of a move from `from` to `to` (lengths along its path, from < to) as a move. Its ends lie on the
/// path; a part that ends with the move ends exactly there. In inverse time mode it takes its share of the time.
Move sub_move(const Move& move, const Geometry& path, double from, double to);

/// Pulses per mm or degree of each axis, which make positions of linear and rotary axes comparable. Axes with 0 are
/// ignored.
using PulsesPerUnit = Point;
inline constexpr PulsesPerUnit units_alone = {1, 1, 1, 1, 1, 1};

/// The point of a path that is nearest to a given position. An arc may have less than a full turn.
struct NearestPoint {
    double length = 0;    ///< along the path
    double distance = 0;  ///< largest difference over the six axes, in pulses
};
NearestPoint nearest_point(const Geometry& path, const Point& position, const PulsesPerUnit& pulses = units_alone);

/// Returns the remaining part of a move that was interrupted at `position`, at most a few pulses off its path. The
/// short remainder of an arc may become a straight line.
Move remaining_move(const Move& move, const Geometry& path, const Point& position,
                    const PulsesPerUnit& pulses = units_alone);

}  // namespace motionrack::control
