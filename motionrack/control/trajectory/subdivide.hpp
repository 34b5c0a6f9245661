// Subdivision of segments along which the limits vary.
#pragma once

#include <motionrack/control/limits.hpp>
#include <motionrack/control/path/path_builder.hpp>

namespace motionrack::control {

/// Returns the part of a segment from x = `from` to `to`.
CubicSegment sub_move(const CubicSegment& piece, double from, double to);

/// Returns the number of parts that keep the limits nearly constant on each. More than one if the curvature takes much
/// of an axis' acceleration and the motion lasts long enough to change its velocity.
int subdivision_count(const CubicSegment& piece, const MachineLimits& limits);

/// Calls `use` with each part.
template <typename Use>
void for_each_subsegment(const CubicSegment& piece, const MachineLimits& limits, const Use& use) {
    const int count = subdivision_count(piece, limits);
    if (count == 1) return use(piece);
    for (int k = 0; k < count; ++k) use(sub_move(piece, piece.length * k / count, piece.length * (k + 1) / count));
}

}  // namespace motionrack::control
