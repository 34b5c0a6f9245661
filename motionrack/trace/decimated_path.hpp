// Decimation of series and paths for drawings, without visible loss.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace motionrack::trace {

/// Returns the indices to keep of a series over increasing `seconds`. Keeps the first, last, minimum and maximum of
/// each of `buckets` equal parts, so that every extreme stays. Samples with a non-finite value or instant are dropped.
/// Returns at most 4 * buckets indices; all valid samples if they are fewer.
std::vector<std::size_t> thin_series(std::span<const double> seconds, std::span<const float> values,
                                     std::size_t buckets);

/// Point of a path with a fourth coordinate, time in units of length, which preserves the velocity along a line.
using PathPoint = std::array<double, 4>;

struct DecimatedPath {
    std::vector<std::size_t> kept;  ///< increasing indices, including first and last
    double within = 0;              ///< maximum distance of dropped points from the chords; < 0: unknown
};

/// Simplifies a path: dropped points lie within `tolerance` of the chord that replaces them, if at most `max_kept`
/// (>= 2) points suffice. Otherwise the tolerance grows until they do. Keeps points with `fixed` true as far as
/// `max_kept` allows (`fixed` empty: none). Drops non-finite points.
DecimatedPath thin_path(const std::vector<PathPoint>& points, const std::vector<bool>& fixed, double tolerance,
                        std::size_t max_kept);

}  // namespace motionrack::trace
