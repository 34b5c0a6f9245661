// From moves to spans: chords are merged, joints are told apart into rests, tangent joins and corners.
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

/// Parts of the tolerance. Merging chords takes an eighth, or as much as a pulse if this is no more than a quarter:
/// roundings of the program's coordinates are of this size. An arc's ends take more at a tangent joint than at a
/// corner, where the corner needs it; two arcs' ends may meet. Moves that are left out take a 500th. What is left is
/// for spreading turns.
inline constexpr double min_merge_share = 0.125;
inline constexpr double max_merge_share = 0.25;
inline constexpr double arc_tangent_share = 0.37;
inline constexpr double arc_corner_share = 0.12;
inline constexpr double inner_share = 0.1;
/// Of a corner, by which its width is judged.
inline constexpr double corner_share = 0.75;
inline constexpr double left_out_share = 0.002;

/// How far the curve may be from the program, by all or by some of its reasons.
struct Tolerance {
    double linear = 0;  ///< mm
    double rotary = 0;  ///< degrees
};

enum class MergedSegmentKind : std::uint8_t { line, arc, rest };

/// A straight line, an arc, or a rest.
struct MergedSegment {
    MergedSegmentKind kind = MergedSegmentKind::rest;
    bool rotary = false;   ///< only ABC move; lengths are degrees
    bool tangent = false;  ///< meets the span before it in the same direction
    std::int32_t line = 0;
    double length = 0;  ///< of u
    Point start = {};
    Point end = {};
    Point tangent_in = {};
    Point tangent_out = {};
    Tolerance tolerance;  ///< in all
    Tolerance merged;     ///< of this, by merging chords
    double feed = 0;      ///< greatest du/dt by the program
    double speed = 0;     ///< the lesser of this and of what the axes can do
    JerkReduction ease_in, ease_out;
    double seconds = 0;              ///< rest
    double corner_tolerance_mm = 0;  ///< rest: how far the path may be from the sides of the corner here
    ArcCurve bow;                    ///< arc
};

/// Takes moves, gives spans in order.
class SegmentMerger {
  public:
    SegmentMerger(const MachineLimits& limits, const Point& start);

    bool has_room() const {
        return made_ - taken_ + 2 * (waiting_past_ - waiting_) + max_a_push + max_a_flush <= capacity;
    }
    void push(const Move& move);
    void flush();

    /// How many spans are complete.
    std::size_t size() const { return made_ - taken_; }
    /// Of these the i-th, from 0.
    const MergedSegment& at(std::size_t i) const { return spans_[(taken_ + i) % capacity]; }
    void pop() { ++taken_; }

  private:
    static constexpr std::size_t capacity = 48;
    static constexpr std::size_t max_a_push = 5, max_a_flush = 3;
    static constexpr std::size_t max_merged = 32;

    Tolerance path_tolerance(const Move& move) const;
    Tolerance room_to_merge(const Tolerance& tolerance) const;
    Geometry shape_of(const Move& move) const;
    bool is_left_out(const Geometry& path) const;
    MergedSegment span_of(const Move& move, const Geometry& path) const;
    void make_line(MergedSegment& span) const;
    bool stops_between(const Geometry& path, const MergedSegment& span) const;
    bool has_width(const MergedSegment& span, const Point& in, const Point& out) const;
    double corner_tolerance(const MergedSegment& before, const MergedSegment& after) const;
    double width_between(const MergedSegment& before, const MergedSegment& after) const;
    LegLimits leg_of(const MergedSegment& span) const;
    bool merge(const Move& move, const MergedSegment& next);
    bool lies_along(const Point& end, const MergedSegment& next) const;
    void add_left_out();
    void close();
    void make_decided();
    void make(const MergedSegment& span) { spans_[made_++ % capacity] = span; }
    void make_rest(double seconds, std::int32_t line, double corner_tolerance_mm, const Point& at);
    void rest(double seconds, std::int32_t line);

    /// A span whose end is not decided yet.
    struct PendingSegment {
        MergedSegment span;
        std::int32_t last_line = 0;      ///< of the last move in it
        double corner_tolerance_mm = 0;  ///< at its end
        CornerStop stop;                 ///< there, if it is one
    };
    Junction joint_between(PendingSegment& before, const MergedSegment& after) const;
    static constexpr std::size_t max_waiting = JunctionPlanner::most + 2;
    PendingSegment& waiting(std::size_t i) { return spans_waiting_[i % max_waiting]; }

    MachineLimits limits_;
    Tolerance half_pulse_;
    JunctionPlanner choice_;
    std::array<PendingSegment, max_waiting> spans_waiting_;
    std::size_t waiting_ = 0, waiting_past_ = 0;
    std::array<MergedSegment, capacity> spans_;
    std::size_t made_ = 0;
    std::size_t taken_ = 0;
    Point position_;  ///< where the last move that was not left out ends
    bool any_left_out_ = false;
    Move skipped_move_;           ///< the last move that was left out; the program is where it ends
    bool stop_left_out_ = false;  ///< of the moves that were left out, one ends at rest
    bool open_ = false;           ///< there is a last span that may still grow
    MergedSegment last_;
    Move last_move_;
    Point last_tangent_ = {};              ///< at the end of the last move
    std::array<Point, max_merged> inner_;  ///< ends of the moves in last_, but its own
    std::size_t inner_count_ = 0;
};

}  // namespace motionrack::control
