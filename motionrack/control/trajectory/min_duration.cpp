// The feasible pairs of neighbouring squares of velocity form a convex polygon with the corner (0, 0), because a lower
// velocity is always allowed. So the squares that can be continued are an interval from 0, and taking the maximum each
// time is fastest.
#include <algorithm>
#include <array>
#include <cmath>
#include <motionrack/control/path/junction.hpp>
#include <motionrack/control/trajectory/min_duration.hpp>
#include <vector>

namespace motionrack::control {

namespace {

constexpr double no_cap = 1e200;
/// Cells of a curved segment, and their approximate number for a whole curve.
constexpr double min_cells = 16, max_cells = 256, cells_of_curve = 2000;
constexpr double much = 0.2;
/// A segment below this share of the curve, which may be left over where blends meet, costs no time, and its curvature
/// is rounding.
constexpr double negligible = 1e-8;

/// A part of a segment. In its middle an axis' acceleration is from * (w at its start) + to * (w at its end).
struct Cell {
    double length = 0;
    double cap = no_cap;    ///< maximum of w in its middle; straight: everywhere on it
    double accel = no_cap;  ///< along u, where the curvature affects no axis
    bool straight = false;
    Point from = {}, to = {};
};

double cap_of(const Point& tangent, const MachineLimits& limits, double feed) {
    const double velocity = std::min(feed, max_velocity_along(tangent, limits));
    return velocity < 1e100 ? velocity * velocity : no_cap;
}

/// Cells, and the maximum of w at each of their ends.
struct Grid {
    Grid(std::span<const CubicSegment> curve, const MachineLimits& limits) {
        const double length = curve.back().begin + curve.back().length;
        caps.push_back(0);
        for (const CubicSegment& piece : curve) add(piece, limits, length);
        caps.back() = 0;
    }

    std::vector<Cell> cells;
    std::vector<double> caps;

  private:
    void add(const CubicSegment& piece, const MachineLimits& limits, double curve_length) {
        if (piece.length < negligible * curve_length) return;
        const bool straight = is_straight(piece);
        const int count = straight
                              ? 1
                              : static_cast<int>(std::clamp(std::ceil(cells_of_curve * piece.length / curve_length),
                                                            min_cells, max_cells));
        const double length = piece.length / count;
        for (int k = 0; k < count; ++k) {
            const double begin = length * k;
            const Point tangent = tangent_on(piece, begin + 0.5 * length),
                        curvature = curvature_on(piece, begin + 0.5 * length);
            Cell cell;
            cell.length = length;
            cell.straight = straight;
            cell.cap = cap_of(tangent, limits, piece.feed);
            for (std::size_t i = 0; i < tangent.size(); ++i) {
                cell.from[i] = 0.5 * (curvature[i] - tangent[i] / length);
                cell.to[i] = 0.5 * (curvature[i] + tangent[i] / length);
                if (tangent[i] != 0) cell.accel = std::min(cell.accel, limits[i].max_accel / std::fabs(tangent[i]));
            }
            cells.push_back(cell);
            caps.back() = std::min(caps.back(), cap_of(tangent_on(piece, begin), limits, piece.feed));
            caps.push_back(cap_of(tangent_on(piece, begin + length), limits, piece.feed));
        }
    }
};

struct Corner {
    double from = 0, to = 0;
};

/// A rectangle from (0, 0), clipped by the accelerations of the axes.
class Polygon {
  public:
    Polygon(double from, double to) : corners_{Corner{0, 0}, {from, 0}, {from, to}, {0, to}}, count_(4) {}

    /// Keeps the part with a * from + b * to <= max; max > 0, so (0, 0) stays.
    void cut(double a, double b, double max) {
        std::array<Corner, max_corners> kept = {};
        std::size_t count = 0;
        const auto slack = [&](const Corner& corner) { return max - (a * corner.from + b * corner.to); };
        for (std::size_t i = 0; i < count_; ++i) {
            const Corner &here = corners_[i], &next = corners_[(i + 1) % count_];
            const double here_slack = slack(here), next_slack = slack(next);
            if (here_slack >= 0) kept[count++] = here;
            if ((here_slack >= 0) == (next_slack >= 0)) continue;
            // From the inner point, which keeps the digits of small squares beside large ones.
            const bool leaves = here_slack >= 0;
            const Corner &in = leaves ? here : next, &out = leaves ? next : here;
            const double part = (leaves ? here_slack : next_slack) / std::fabs(here_slack - next_slack);
            kept[count++] = {in.from + part * (out.from - in.from), in.to + part * (out.to - in.to)};
        }
        corners_ = kept;
        count_ = count;
    }
    double max_from() const {
        double max = 0;
        for (std::size_t i = 0; i < count_; ++i) max = std::max(max, corners_[i].from);
        return max;
    }

  private:
    /// A cut adds one corner, or two by rounding.
    static constexpr std::size_t max_corners = 4 + 4 * axis_count;
    std::array<Corner, max_corners> corners_;
    std::size_t count_;
};

/// Returns the maximum w at the start of a cell, up to `cap`, from which at most `next` is reachable at its end.
double back_over(const Cell& cell, double cap, double next, const MachineLimits& limits) {
    if (cell.straight) return std::min(cap, next + 2 * cell.accel * cell.length);
    Polygon polygon(cap, next);
    for (std::size_t i = 0; i < limits.size(); ++i) {
        if (cell.from[i] == 0 && cell.to[i] == 0) continue;
        polygon.cut(cell.from[i], cell.to[i], limits[i].max_accel);
        polygon.cut(-cell.from[i], -cell.to[i], limits[i].max_accel);
    }
    return polygon.max_from();
}

/// Returns the maximum w at the end of a cell, up to `cap`, after `square` at its start.
double ahead_over(const Cell& cell, double square, double cap, const MachineLimits& limits) {
    if (cell.straight) return std::min(cap, square + 2 * cell.accel * cell.length);
    for (std::size_t i = 0; i < limits.size(); ++i) {
        const double max_accel = limits[i].max_accel, begun = cell.from[i] * square;
        if (cell.to[i] > 0) cap = std::min(cap, (max_accel - begun) / cell.to[i]);
        if (cell.to[i] < 0) cap = std::min(cap, (max_accel + begun) / -cell.to[i]);
    }
    return std::max(cap, 0.0);
}

/// Returns the duration of a cell between two squares of the velocity, s. Within a straight cell the velocity may rise
/// and fall. The same model applies to a curved cell in which the velocity changes much.
double seconds_over(const Cell& cell, double from, double to) {
    const double begin = std::sqrt(from), end = std::sqrt(to);
    if (!cell.straight && std::fabs(to - from) < much * std::max(from, to)) return 2 * cell.length / (begin + end);
    // The curvature helps to change the velocity by more.
    if (!cell.straight && std::fabs(to - from) > 2 * cell.accel * cell.length) return 2 * cell.length / (begin + end);
    const double max_velocity2 = std::max({from, to, std::min(cell.cap, 0.5 * (from + to) + cell.accel * cell.length)});
    const double fast = std::sqrt(max_velocity2);
    const double even = cell.length - ((max_velocity2 - from) + (max_velocity2 - to)) / (2 * cell.accel);
    return (fast - begin + fast - end) / cell.accel + std::max(0.0, even) / fast;
}

}  // namespace

double min_duration_s(std::span<const CubicSegment> curve, const MachineLimits& limits) {
    if (curve.empty()) return 0;
    const Grid grid(curve, limits);
    std::vector<double> squares = grid.caps;
    for (std::size_t i = grid.cells.size(); i-- > 0;)
        squares[i] = back_over(grid.cells[i], grid.caps[i], squares[i + 1], limits);
    double seconds = 0;
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
        squares[i + 1] = ahead_over(grid.cells[i], squares[i], squares[i + 1], limits);
        seconds += seconds_over(grid.cells[i], squares[i], squares[i + 1]);
    }
    return seconds;
}

}  // namespace motionrack::control
