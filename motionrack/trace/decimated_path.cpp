// Decimation of series (extremes of equal parts) and of paths (Ramer-Douglas-Peucker, in pieces of limited length).
#include <algorithm>
#include <cmath>
#include <motionrack/trace/decimated_path.hpp>
#include <utility>

namespace motionrack::trace {

namespace {

using Indices = std::vector<std::size_t>;

constexpr std::size_t max_piece_elements = 1024;  ///< limits the run time for paths that cannot be simplified

/// Returns the squared distance of p from the chord a b.
double distance_squared(const PathPoint& p, const PathPoint& a, const PathPoint& b) {
    double along = 0, length = 0, apart = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double chord = b[i] - a[i];
        const double offset = p[i] - a[i];
        along += chord * offset;
        length += chord * chord;
        apart += offset * offset;
    }
    if (length <= 0) return apart;
    if (along <= 0) return apart;
    if (along < length) return std::max(0.0, apart - along * along / length);
    double beyond = 0;
    for (std::size_t i = 0; i < 4; ++i) beyond += (p[i] - b[i]) * (p[i] - b[i]);
    return beyond;
}

/// Marks the points to keep between the ends of one piece of `indices`.
void split(const std::vector<PathPoint>& points, const Indices& indices, std::size_t first, std::size_t last,
           double limit, std::vector<bool>& keep) {
    std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        double max_distance = limit;
        std::size_t at = 0;
        for (std::size_t i = a + 1; i < b; ++i) {
            const double d = distance_squared(points[indices[i]], points[indices[a]], points[indices[b]]);
            if (d > max_distance) max_distance = d, at = i;
        }
        if (at == 0) continue;
        keep[at] = true;
        open.emplace_back(a, at);
        open.emplace_back(at, b);
    }
}

Indices thin_once(const std::vector<PathPoint>& points, const Indices& indices, const std::vector<bool>& fixed,
                  double tolerance) {
    std::vector<bool> keep(indices.size(), false);
    std::size_t first = 0;
    keep.front() = keep.back() = true;
    for (std::size_t i = 1; i < indices.size(); ++i) {
        const bool ends =
            i + 1 == indices.size() || (!fixed.empty() && fixed[indices[i]]) || i - first >= max_piece_elements;
        if (!ends) continue;
        keep[i] = true;
        split(points, indices, first, i, tolerance * tolerance, keep);
        first = i;
    }
    Indices kept;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (keep[i]) kept.push_back(indices[i]);
    }
    return kept;
}

}  // namespace

Indices thin_series(std::span<const double> seconds, std::span<const float> values, std::size_t buckets) {
    Indices good;
    for (std::size_t i = 0; i < std::min(seconds.size(), values.size()); ++i) {
        if (std::isfinite(seconds[i]) && std::isfinite(values[i])) good.push_back(i);
    }
    if (buckets == 0 || good.size() <= 4 * buckets) return good;
    Indices kept;
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        const std::size_t begin = good.size() / buckets * bucket + good.size() % buckets * bucket / buckets;
        const std::size_t end = good.size() / buckets * (bucket + 1) + good.size() % buckets * (bucket + 1) / buckets;
        std::size_t min_index = begin, max_index = begin;
        for (std::size_t i = begin; i < end; ++i) {
            if (values[good[i]] < values[good[min_index]]) min_index = i;
            if (values[good[i]] > values[good[max_index]]) max_index = i;
        }
        std::array<std::size_t, 4> four = {begin, min_index, max_index, end - 1};
        std::sort(four.begin(), four.end());
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == 0 || four[i] != four[i - 1]) kept.push_back(good[four[i]]);
        }
    }
    return kept;
}

DecimatedPath thin_path(const std::vector<PathPoint>& points, const std::vector<bool>& fixed, double tolerance,
                        std::size_t max_kept) {
    DecimatedPath path;
    Indices& kept = path.kept;
    std::size_t bound = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const bool finite = std::all_of(points[i].begin(), points[i].end(), [](double v) { return std::isfinite(v); });
        if (finite) kept.push_back(i);
        if (finite && !fixed.empty() && fixed[i]) ++bound;
    }
    if (kept.size() < 3) return path;
    const std::vector<bool> none;
    const std::vector<bool>& corners = bound + 2 <= max_kept ? fixed : none;
    for (int round = 0; round < 60; ++round) {
        kept = thin_once(points, kept, corners, tolerance);
        path.within += tolerance;
        if (kept.size() <= max_kept) return path;
        tolerance = tolerance > 0 ? tolerance * 2 : 1e-9;
    }
    Indices some;  // coordinates too irregular for any tolerance
    for (std::size_t i = 0; i + 1 < max_kept; ++i) some.push_back(kept[i * (kept.size() - 1) / (max_kept - 1)]);
    some.push_back(kept.back());
    return {some, -1};
}

}  // namespace motionrack::trace
