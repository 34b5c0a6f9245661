// Merges moves into segments: merges chords, and classifies junctions as stops, tangent junctions and corners.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <motionrack/control/geometry.hpp>
#include <motionrack/control/limits.hpp>
#include <motionrack/control/move.hpp>
#include <motionrack/control/path/arc_curve.hpp>
#include <motionrack/control/path/corner_stop.hpp>
#include <motionrack/control/path/junction_planner.hpp>

namespace motionrack::control {

/// Shares of the tolerance. Merging chords takes an eighth, or a whole pulse if that is at most a quarter, because
/// program coordinates are rounded by about a pulse. The ends of an arc take more at a tangent junction than at a
/// corner, which needs it; the ends of two arcs may meet. Skipped moves use 1/500. The rest is for corner blends.
inline constexpr double min_merge_share = 0.125;
inline constexpr double max_merge_share = 0.25;
inline constexpr double arc_tangent_share = 0.37;
inline constexpr double arc_corner_share = 0.12;
inline constexpr double inner_share = 0.1;
/// Share of a corner's tolerance that decides whether its blend is long enough.
inline constexpr double corner_share = 0.75;
inline constexpr double left_out_share = 0.002;

/// Deviation of the curve from the program, in total or from some causes.
struct Tolerance {
    double linear = 0;  ///< mm
    double rotary = 0;  ///< degrees
};

enum class MergedSegmentKind : std::uint8_t { line, arc, rest };

/// A straight line, an arc, or a stop.
struct MergedSegment {
    MergedSegmentKind kind = MergedSegmentKind::rest;
    bool rotary = false;   ///< only ABC move; lengths are in degrees
    bool tangent = false;  ///< same direction as the end of the segment before
    std::int32_t line = 0;
    double length = 0;  ///< length in u
    Point start = {};
    Point end = {};
    Point tangent_in = {};
    Point tangent_out = {};
    Tolerance tolerance;  ///< total tolerance
    Tolerance merged;     ///< part of it that merging chords used
    double feed = 0;      ///< maximum du/dt by the programmed feed rate
    double velocity = 0;  ///< maximum du/dt by `feed` and the limits of the axes
    JerkReduction ease_in, ease_out;
    double seconds = 0;              ///< rest: dwell time
    double corner_tolerance_mm = 0;  ///< rest: largest distance of the path from the sides of the corner here
    ArcCurve arc;                    ///< arc: its curve
};

/// Merges moves into segments, in program order.
class SegmentMerger {
  public:
    SegmentMerger(const MachineLimits& limits, const Point& start);

    bool has_room() const {
        return made_ - taken_ + 2 * (waiting_past_ - waiting_) + max_a_push + max_a_flush <= capacity;
    }
    void push(const Move& move);
    void flush();

    /// Returns the number of complete segments.
    std::size_t size() const { return made_ - taken_; }
    /// Returns the i-th complete segment, from 0.
    const MergedSegment& at(std::size_t i) const { return segments_[(taken_ + i) % capacity]; }
    void pop() { ++taken_; }

  private:
    static constexpr std::size_t capacity = 48;
    static constexpr std::size_t max_a_push = 5, max_a_flush = 3;
    static constexpr std::size_t max_merged = 32;

    Tolerance path_tolerance(const Move& move) const;
    Tolerance merge_tolerance(const Tolerance& tolerance) const;
    Geometry shape_of(const Move& move) const;
    bool is_left_out(const Geometry& path) const;
    bool turns_otherwise(const Move& move) const;
    bool is_rotary_alone(const Move& move, const Geometry& path) const;
    MergedSegment segment_of(const Move& move, const Geometry& path) const;
    void make_line(MergedSegment& segment) const;
    bool stops_between(const Geometry& path, const MergedSegment& segment) const;
    bool has_width(const MergedSegment& segment, const Point& in, const Point& out) const;
    double corner_tolerance(const MergedSegment& before, const MergedSegment& after) const;
    double width_between(const MergedSegment& before, const MergedSegment& after) const;
    LegLimits leg_of(const MergedSegment& segment) const;
    bool merge(const Move& move, const MergedSegment& next);
    bool lies_along(const Point& end, const MergedSegment& next) const;
    void add_left_out();
    void close();
    void make_decided();
    void make(const MergedSegment& segment) { segments_[made_++ % capacity] = segment; }
    void make_rest(double seconds, std::int32_t line, double corner_tolerance_mm, const Point& at);
    void rest(double seconds, std::int32_t line);

    /// A segment whose end is not decided yet.
    struct PendingSegment {
        MergedSegment segment;
        std::int32_t last_line = 0;      ///< line of its last move
        double corner_tolerance_mm = 0;  ///< corner tolerance at its end
        CornerStop stop;                 ///< stop at its end, if chosen
    };
    Junction junction_joining(PendingSegment& before, const MergedSegment& after) const;
    static constexpr std::size_t max_waiting = JunctionPlanner::max_junctions + 2;
    PendingSegment& waiting(std::size_t i) { return pending_[i % max_waiting]; }

    MachineLimits limits_;
    Tolerance half_pulse_;
    JunctionPlanner choice_;
    std::array<PendingSegment, max_waiting> pending_;
    std::size_t waiting_ = 0, waiting_past_ = 0;
    std::array<MergedSegment, capacity> segments_;
    std::size_t made_ = 0;
    std::size_t taken_ = 0;
    Point position_;  ///< end of the last move that was not skipped
    bool any_left_out_ = false;
    Move skipped_move_;           ///< the last skipped move; the programmed position is its end
    bool stop_left_out_ = false;  ///< one of the skipped moves ends with a stop
    bool open_ = false;           ///< last_ exists and may still grow
    MergedSegment last_;
    Move last_move_;
    Point last_tangent_ = {};              ///< tangent at the end of the last move
    std::array<Point, max_merged> inner_;  ///< ends of the moves merged in last_, except its own end
    std::size_t inner_count_ = 0;
};

}  // namespace motionrack::control
