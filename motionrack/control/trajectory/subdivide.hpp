// Pieces of a curve, cut where limits change along them.
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>

namespace motionrack::control {

/// The piece from x = `from` to `to`.
CubicSegment sub_move(const CubicSegment& piece, double from, double to);

/// Into how many parts a piece is cut, so that the limits on each are nearly the same all over it: where a curvature
/// takes a good part of an axis' acceleration, and the motion on it lasts long enough for the speed to change.
int subdivision_count(const CubicSegment& piece, const MachineLimits& limits);

/// Calls `use` with each part.
template <typename Use>
void for_each_subsegment(const CubicSegment& piece, const MachineLimits& limits, const Use& use) {
    const int count = subdivision_count(piece, limits);
    if (count == 1) return use(piece);
    for (int k = 0; k < count; ++k) use(sub_move(piece, piece.length * k / count, piece.length * (k + 1) / count));
}

}  // namespace motionrack::control
