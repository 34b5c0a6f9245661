// The marked part: the path of the spot over it, in part coordinates, with the energy per millimetre.
//
//   add(from, to, J) ──► strokes: chains of points; straight sections of uniform energy are one segment
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
    double tolerance_mm = 0.0002;        ///< maximum deviation of a segment from the marks, 0 .. 10
    std::size_t max_points = 4'000'000;  ///< further points are counted, not stored
};

/// A point of a stroke, with the mark up to it.
struct MarkedPoint {
    sim::Spot at;         ///< mm
    double j_per_mm = 0;  ///< energy density of the segment that ends here; 0 at a stroke's first point
    double dwell_j = 0;   ///< energy at this very position while the spot was stationary
    double begun_s = 0;   ///< start of the segment; at a first point: of the stroke
    bool first = false;
};

/// A straight segment of a drawing, mm.
struct DrawnSegment {
    sim::Spot from, to;
};

/// Deviation of the marks from a drawing.
struct Deviation {
    double max_mm = 0, rms_mm = 0;  ///< over points along the marks, weighted by length
    sim::Spot max_at;               ///< on the part
    double max_s = 0;               ///< start of that segment
    double missing_mm = 0;          ///< length of the drawing with no mark within `near_mm`
};

/// Compares marked points with the drawing and the reverse, at steps of `step_mm`.
Deviation compare(std::span<const MarkedPoint> points, std::span<const DrawnSegment> drawing, double step_mm = 0.05,
                  double near_mm = 0.1);

class Workpiece {
  public:
    explicit Workpiece(const WorkpieceSettings& settings = {}) : settings_(settings) {}

    /// Adds a straight motion of the spot from -> to in `seconds` from `begun_s` on, with `joules` in total.
    void add(sim::Spot from, sim::Spot to, double joules, double begun_s);
    /// Converts the segment being collected to points; call before reading.
    void finish();

    std::span<const MarkedPoint> points() const {
        return std::span(points_).first(static_cast<std::size_t>(state_.points));
    }
    /// The segment being collected, if any.
    std::optional<DrawnSegment> collecting() const;
    std::uint64_t lost_points() const { return static_cast<std::uint64_t>(state_.lost); }
    double length_mm() const { return state_.length; }
    double energy_j() const { return state_.energy; }
    /// Compares the marks with a drawing.
    Deviation compare(std::span<const DrawnSegment> drawing, double step_mm = 0.05, double near_mm = 0.1) const {
        return parts::compare(points(), drawing, step_mm, near_mm);
    }

    /// State except the points: points are only appended, so their number identifies them.
    std::span<std::byte> state() { return std::as_writable_bytes(std::span(&state_, 1)); }
    /// Reserves memory for max_points: no later allocation.
    void reserve() { points_.reserve(settings_.max_points); }
    /// Takes the points of the work piece whose state was copied.
    void copy_points(const Workpiece& other) { points_.assign(other.points().begin(), other.points().end()); }

  private:
    void keep(const MarkedPoint& point);
    void flush();

    struct State {
        std::int64_t points = 0, lost = 0;
        double length = 0, energy = 0;
        // The segment being collected: from start to end along way (a unit vector).
        sim::Spot start, end, direction;
        double collected_j = 0, collected_mm = 0, begun_s = 0, dwell_j = 0;
        std::int64_t collecting = 0, chained = 0;
    };
    WorkpieceSettings settings_;
    std::vector<MarkedPoint> points_;  // may contain later points if a snapshot was restored
    State state_;
};

/// Finds the nearest of many segments, which are sorted into squares.
class NearestSegment {
  public:
    explicit NearestSegment(std::span<const DrawnSegment> segments);
    /// mm from `p` to the nearest segment; infinity if there is none.
    double distance(sim::Spot p) const;

  private:
    std::int64_t column(double x) const;
    std::int64_t row(double y) const;
    /// Lowers `best2`, a squared distance, to that of the nearest segment of the square.
    void look_in(std::size_t square, sim::Spot p, double& best2) const;

    std::vector<DrawnSegment> segments_;
    sim::Spot low_;
    double side_ = 1;
    std::int64_t columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> begins_, members_;
};

}  // namespace motionrack::parts
