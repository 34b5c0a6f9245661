// Fewer points for a picture: what the eye would miss stays, the rest goes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace motionrack::trace {

/// Indices to keep of a series over `seconds`, rising: the first, last, least and greatest value of each of `buckets`
/// equal parts of the samples, so every extreme stays. Samples whose value or instant is not finite are never kept. At
/// most 4 * buckets indices; all good samples if they are no more than that.
std::vector<std::size_t> thin_series(std::span<const double> seconds, std::span<const float> values,
                                     std::size_t buckets);

/// A point of a path and a fourth coordinate, the time in units of length, so that the speed along a line stays
/// visible.
using PathPoint = std::array<double, 4>;

struct DecimatedPath {
    std::vector<std::size_t> kept;  ///< indices, rising, first and last included
    double within = 0;              ///< what was left out lies no farther than this from the chords; < 0: not known
};

/// Thins a path: what is left out lies within `tolerance` of the chord that replaces it, where no more than `most` (>=
/// 2) points are needed for that; else the tolerance grows until they are enough. Points with `fixed` true are kept
/// while they do not exceed `most` (`fixed` empty: none). Points that are not finite are never kept.
DecimatedPath thin_path(const std::vector<PathPoint>& points, const std::vector<bool>& fixed, double tolerance,
                        std::size_t most);

}  // namespace motionrack::trace
