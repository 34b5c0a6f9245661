// The part as it looks afterwards: where the spot went over it, in its own coordinates, and with how much energy a
// millimetre.
//
//   add(from, to, J) ──► strokes: chains of points; straight stretches of even energy are one segment
#pragma once

#include <cstddef>
#include <cstdint>
#include <motionrack/base/result.hpp>
#include <motionrack/sim/blocks/scan_lens.hpp>
#include <optional>
#include <span>
#include <vector>

namespace motionrack::parts {

struct WorkpieceSettings {
    double tolerance_mm = 0.0002;        ///< how far a segment may be off what was marked, 0 .. 10
    std::size_t max_points = 4'000'000;  ///< more are counted, not kept
};

/// A point of a stroke and what was marked on the way to it.
struct MarkedPoint {
    sim::Spot at;         ///< mm
    double j_per_mm = 0;  ///< of the segment that ends here; 0 in a stroke's first point
    double dwell_j = 0;   ///< put into this very place, while the spot stood
    double begun_s = 0;   ///< when the segment began; in a first point: the stroke
    bool first = false;
};

/// A straight piece of a drawing, mm.
struct Segment {
    sim::Spot from, to;
};

/// How far what was marked is off a drawing.
struct Deviation {
    double worst_mm = 0, rms_mm = 0;  ///< over points along the marks, weighted by length
    sim::Spot worst_at;               ///< on the part
    double worst_s = 0;               ///< when that segment began
    double missing_mm = 0;            ///< length of the drawing with no mark within `near_mm`
};

/// Marked points against the drawing and the drawing against them, looked at every `step_mm`.
Deviation compare(std::span<const MarkedPoint> points, std::span<const Segment> drawing, double step_mm = 0.05,
                  double near_mm = 0.1);

class Workpiece {
  public:
    explicit Workpiece(const WorkpieceSettings& settings = {}) : settings_(settings) {}

    /// The spot went straight from -> to in `seconds` from `begun_s` on, with `joules` in all.
    void add(sim::Spot from, sim::Spot to, double joules, double begun_s);
    /// What is being collected becomes points. Before reading.
    void finish();

    std::span<const MarkedPoint> points() const {
        return std::span(points_).first(static_cast<std::size_t>(state_.points));
    }
    /// What is being collected and no point yet, if anything.
    std::optional<Segment> collecting() const;
    std::uint64_t lost_points() const { return static_cast<std::uint64_t>(state_.lost); }
    double length_mm() const { return state_.length; }
    double energy_j() const { return state_.energy; }
    /// What is on it against a drawing.
    Deviation compare(std::span<const Segment> drawing, double step_mm = 0.05, double near_mm = 0.1) const {
        return parts::compare(points(), drawing, step_mm, near_mm);
    }

    /// All but the points themselves: points come only behind others, so that their number says which there were.
    std::span<std::byte> state() { return std::as_writable_bytes(std::span(&state_, 1)); }
    /// Makes room for max_points: from here on nothing is allocated.
    void reserve() { points_.reserve(settings_.max_points); }
    /// The points of a work piece whose state was copied.
    void copy_points(const Workpiece& other) { points_.assign(other.points().begin(), other.points().end()); }

  private:
    void keep(const MarkedPoint& point);
    void flush();

    struct State {
        std::int64_t points = 0, lost = 0;
        double length = 0, energy = 0;
        // The segment being collected: from start to end along way (a unit vector).
        sim::Spot start, end, way;
        double collected_j = 0, collected_mm = 0, begun_s = 0, dwell_j = 0;
        std::int64_t collecting = 0, chained = 0;
    };
    WorkpieceSettings settings_;
    std::vector<MarkedPoint> points_;  // may be more than there are: what came after a snapshot that was restored
    State state_;
};

/// Finds the nearest of many segments; their places are sorted into squares.
class Nearest {
  public:
    explicit Nearest(std::span<const Segment> segments);
    /// mm from `p` to the nearest segment; infinity if there is none.
    double distance(sim::Spot p) const;

  private:
    std::int64_t column(double x) const;
    std::int64_t row(double y) const;
    /// Lowers `best2`, the square of a distance, to that of the nearest segment of the square.
    void look_in(std::size_t square, sim::Spot p, double& best2) const;

    std::vector<Segment> segments_;
    sim::Spot low_;
    double side_ = 1;
    std::int64_t columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> begins_, members_;
};

}  // namespace motionrack::parts
